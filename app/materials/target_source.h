#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/loading/scene_loading.h"
#include "engine/scene/picture_size.h"
#include "engine/surface/surface.h"

namespace nacre {

// What nacre target takes, as text.
struct TargetCommandArguments {
    std::string source;
    std::filesystem::path output;
    std::string from;
    std::string up;
    std::string turn;
    std::string size;
    std::filesystem::path normalMap;
    std::string normalY;
    std::string heightScale;
    std::string device;
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

struct TargetStage {
    std::string name;
    double seconds = 0;
};

// A surface without materials, and what is said of it.
struct TargetReport {
    Surface surface;
    std::vector<std::string> lines;    // heading and text
    std::vector<std::string> warnings; // for stderr
    std::vector<TargetStage> stages;
};

// SOURCE is a mesh, a height or normal map, NAME.nacre or make:SPECIFICATION. Throws Error: usage where an option has
// nothing to do with it, data where it cannot be used.
TargetReport targetFromSource(const TargetCommandArguments& arguments);

// The surface of make:SPECIFICATION. Throws Error (usage) where it is not understood.
Surface generatedShape(const std::string& source, const PictureSize& size, int threads);

// With the generated shapes.
SceneInputs sceneInputs(const std::filesystem::path& fits);

} // namespace nacre
