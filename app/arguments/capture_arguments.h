#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "acquisition/chain/acquire.h"

namespace nacre {

// Of --transfer; throws a usage Error.
TransferCurve curveFromName(const std::string& name);

// Which capture, and what is known of its lights: all that `calibrate` needs, and the first part of CaptureArguments.
struct CalibrationArguments {
    std::filesystem::path folder;
    CaptureOptions capture;
    std::vector<std::string> mirrorSpheres; // for capture
    std::string transfer;
    std::string offset;
    std::string lightDistance;
    std::vector<double> circle;
    std::vector<int> crop;
    int shrink = 1;
    std::vector<float> sphereReflectance;
    std::filesystem::path compareRig;
    int threads = 0;
    bool quiet = false;
    bool force = false;

    void addTo(CLI::App& command);
    Capture load();
    CalibrationOptions calibrationOptions() const; // throws usage Errors
};

// What `acquire` and `normals` share: a capture, and how normals are estimated.
struct CaptureArguments : CalibrationArguments {
    std::string normals = nameOf(NormalOptions{}.method);
    std::string intensities = "auto";
    std::string selfLight = "auto";
    std::optional<int> lightsGiven; // empty: all
    size_t triples = NormalOptions{}.triples;
    uint64_t seed = NormalOptions{}.seed;
    std::filesystem::path fits;
    std::vector<std::string> excludedReflectances;
    std::vector<float> thresholds;
    std::filesystem::path json;
    std::filesystem::path debugFolder;

    void addTo(CLI::App& command);
    // The stages' options as the command line set them; throws usage Errors.
    AcquireOptions stageOptions() const;
};

} // namespace nacre
