#pragma once
#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "engine/brdf/brdf_audit.h"
#include "engine/brdf/brdf_comparison.h"
#include "engine/materials/material_specification.h"

namespace nacre {

// What `nacre brdf` found out.
struct BrdfReport {
    BrdfSource source;
    BrdfAudit audit;
    std::string against; // name of what it was compared to
    std::optional<BrdfComparison> comparison;
};

// Of a table's texels whose light and view are above the horizon, the share that is covered.
double coveredShare(const BrdfTable& table);

void print(const BrdfReport& report);
nlohmann::json jsonOf(const BrdfReport& report);
nlohmann::json jsonOf(const BrdfComparison& comparison);

} // namespace nacre
