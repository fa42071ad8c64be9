#pragma once
#include <filesystem>

#include "engine/scene/scene_file.h"

namespace nacre {

// What nacre render takes, as text: from the command line, and where that is silent from a state file.
struct RenderArguments : SceneFile {
    std::filesystem::path fits;
    std::string rig; // lights beside those of --light and --environment
    std::string device;
    std::filesystem::path state;
    std::filesystem::path output;
    bool force = false;
    bool quiet = false;
};

// Fills what is empty from arguments.state, where that is given.
void completeFromState(RenderArguments& arguments);

} // namespace nacre
