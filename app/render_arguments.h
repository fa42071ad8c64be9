#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nacre {

// What nacre render takes, as text: from the command line, and where that is silent from a state file.
struct RenderArguments {
    std::filesystem::path surface;
    std::string material; // in place of a surface's
    std::filesystem::path fits;
    std::filesystem::path onto;
    std::string normalY;
    std::string size;
    std::vector<std::string> lights;
    std::filesystem::path environment;
    std::optional<int> environmentLights;
    std::optional<float> environmentTurn; // degrees
    std::string view;
    std::string path;
    std::optional<float> exposure; // stops
    std::string tone;
    std::optional<int> frames;
    std::string motion;
    std::string device;
    std::filesystem::path state;
    std::filesystem::path output;
    bool force = false;
    bool quiet = false;
};

// Fills what is empty from arguments.state, where that is given: keys are the options' names (docs/formats.md), paths
// are relative to the file.
void completeFromState(RenderArguments& arguments);

} // namespace nacre
