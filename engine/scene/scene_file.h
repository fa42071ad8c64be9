#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nacre {

// How a window shows the picture of a scene; a picture that is written without one takes no notice of it.
struct WindowFile {
    std::optional<float> zoom;          // screen pixels a pixel of the picture; empty: fitted
    std::vector<float> centre;          // x, y of the picture in the middle of the window, pixels; empty: its middle
    std::vector<std::string> materials; // further ones to choose from, as --material has them
    std::vector<std::filesystem::path> targets;      // further shapes, as --onto has them
    std::vector<std::filesystem::path> environments; // further ones
    std::string wipeMaterial;                        // right of the wipe's line, as --material has it; empty: no wipe
    std::optional<float> wipeAt;                     // the line, a share of the picture's width
    bool operator==(const WindowFile&) const = default;
};

// A whole scene as text: what state files hold (docs/formats.md), named after the options of nacre render. Empty: not
// said.
struct SceneFile {
    std::filesystem::path surface;
    std::string material; // in place of a surface's
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
    std::string show;
    std::optional<int> frames;
    std::string motion;
    std::optional<bool> shadows{}; // cast by the height
    std::string residual;
    WindowFile window;
    bool operator==(const SceneFile&) const = default;
};

// Fills what is empty in the scene from a state file. Paths in it are relative to the file. Throws Error.
void completeScene(SceneFile& scene, const std::filesystem::path& file);

// The state file's text; paths relative to `folder`, where it is to be written.
std::string textOf(const SceneFile& scene, const std::filesystem::path& folder);

} // namespace nacre
