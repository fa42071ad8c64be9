#pragma once
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>

#include "acquisition/brdf/model_ladder.h"
#include "acquisition/residual/residual_estimate.h"

namespace nacre {

// The layer for what the BRDF cannot explain: --residual.
struct ResidualArguments {
    std::string choice = "auto";

    void addTo(CLI::App& command);
    // Its size follows what is asked of the BRDF's. Throws usage Errors.
    ResidualOptions options(const LadderOptions& ladder) const;
};

// One line for the user; empty where no layer was thought of.
std::string describe(const ResidualReport& report);
nlohmann::json documentOf(const ResidualReport& report);

} // namespace nacre
