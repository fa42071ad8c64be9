#pragma once
#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "acquisition/acquire.h"

namespace nacre {

// What `acquire` and `normals` share: which capture, what is known of its lights, how normals are estimated.
struct CaptureArguments {
    std::filesystem::path folder;
    CaptureOptions capture;
    std::string transfer;
    std::vector<float> sphereReflectance;
    std::string normals = "auto";
    size_t triples = 300;
    uint64_t seed = 1;
    std::filesystem::path fits;
    std::vector<std::string> excludedReflectances;
    std::vector<float> thresholds;
    std::filesystem::path compareRig;
    std::filesystem::path json;
    std::filesystem::path debugFolder;
    int threads = 0;
    bool quiet = false;
    bool force = false;

    void addTo(CLI::App& command);
    Capture load();
    // The stages' options as the command line set them; throws usage Errors.
    AcquireOptions stageOptions() const;
};

} // namespace nacre
