#pragma once
#include <string>

#include <CLI/CLI.hpp>

#include "acquisition/brdf/model_ladder.h"

namespace nacre {

// How a table is filled from samples: --interpolation, --k.
struct InterpolationArguments {
    std::string method = nameOf(InterpolationOptions{}.method);
    std::string k = std::to_string(InterpolationOptions{}.k);

    void addTo(CLI::App& command);
    InterpolationOptions options(int threads) const; // throws usage Errors
};

// How large a model may be: --tolerance, --budget-bytes.
struct LadderArguments {
    std::string tolerance; // dB, with or without the unit
    std::string budget;    // bytes, KiB or MiB after the number

    void addTo(CLI::App& command);
    LadderOptions options(int threads) const; // throws usage Errors
};

} // namespace nacre
