#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "acquisition/brdf/cornell_samples.h"
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

// Of a table's texels whose light and view are above the horizon, the share that is covered, and the share whose
// expected error is at most kUncertainError.
double coveredShare(const BrdfTable& table);
double certainShare(const BrdfTable& table);

void print(const BrdfReport& report);
nlohmann::json jsonOf(const BrdfReport& report);
nlohmann::json jsonOf(const BrdfComparison& comparison);

// How well four fifths of a list of measurements predict the last fifth, by one way of interpolating.
struct ScatteredPrediction {
    std::string method;
    BrdfComparison all;
    BrdfComparison steep; // light and view at most kSteepDegrees from the normal: no grazing peak sets the scale
};

inline constexpr float kSteepDegrees = 62; // of the instrument's steps of 10 degrees, 60 is the last below

struct ScatteredReport {
    std::filesystem::path file;
    CornellMeasurements measurements;
    size_t given = 0; // that were interpolated
    std::vector<ScatteredPrediction> predictions;
};

ScatteredReport examineScattered(const std::filesystem::path& file, int threads);

void print(const ScatteredReport& report);
nlohmann::json jsonOf(const ScatteredReport& report);

} // namespace nacre
