#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "evaluation/charts/chart_measurement.h"

namespace nacre {

// Which captures `chart` looks at, and what it tries.
struct ChartArguments {
    std::vector<std::filesystem::path> captures;
    CaptureOptions capture;
    std::filesystem::path output, fits;
    std::vector<std::string> parts{"normals", "brdf", "rendering"};
    std::vector<std::string> methods, lights, neighbours, frameLights;
    std::string frameSize = fmt::format("{}x{}", RenderingChoices{}.width, RenderingChoices{}.height);
    std::string device;
    int threads = 0;
    bool quiet = false, force = false;

    void addTo(CLI::App& command);
    ChartChoices choices() const; // throws usage Errors
};

} // namespace nacre
