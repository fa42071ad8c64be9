#pragma once
#include <string>

#include <CLI/CLI.hpp>

#include "acquisition/brdf/interpolation.h"

namespace nacre {

// How a table is filled from samples: --interpolation, --k.
struct InterpolationArguments {
    std::string method = "local-linear";
    std::string k = "25";

    void addTo(CLI::App& command);
    InterpolationOptions options(int threads) const; // throws usage Errors
};

} // namespace nacre
