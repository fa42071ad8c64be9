#pragma once
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include "acquisition/brdf/model_ladder.h"
#include "acquisition/chain/cast_shadow_report.h"
#include "acquisition/residual/residual_estimate.h"

namespace nacre {

// How a table is filled from samples: --interpolation, --k, --unseen.
struct InterpolationArguments {
    std::string method = nameOf(InterpolationOptions{}.method);
    std::string k = std::to_string(InterpolationOptions{}.k);
    std::string unseen = "prior";

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

// What else explains photographs: --cast-shadows, and the layer for what is left, --residual.
struct ResidualArguments {
    std::string choice = "auto";
    std::string shadows = "auto";

    void addTo(CLI::App& command);
    // Its size follows what is asked of the BRDF's. Throws usage Errors.
    ResidualOptions options(const LadderOptions& ladder) const;
    bool castShadows() const; // throws usage Errors
};

// One line for the user; empty where none was thought of.
std::string describe(const CastShadowReport& report);
std::string describe(const ResidualReport& report);
nlohmann::json documentOf(const CastShadowReport& report);
nlohmann::json documentOf(const ResidualReport& report);

} // namespace nacre
