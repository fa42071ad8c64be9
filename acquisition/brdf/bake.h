#pragma once
#include <optional>
#include <string>

#include "acquisition/brdf/interpolation.h"
#include "engine/brdf/brdf_table.h"
#include "engine/lights/light.h"

namespace nacre {

// Which thetaD a table spans: as far as lights were captured, to 45 degrees (all that lights before a fixed camera can
// ask for), or all of 90. What lies beyond the samples is extrapolated, and its coverage says so.
enum class TableRange { captured, front, full };

// "captured", "front", "full"; a usage Error lists the names.
TableRange tableRangeFromName(const std::string& name);

struct BakeOptions {
    std::optional<int> coordinates{}; // none: half-difference, or one-way where photographs ask for it (reciprocity.h)
    TableRange range = TableRange::captured;
    // Texels; 0: from the domain, see tableSize.
    glm::ivec3 size{0};
    int threads = 0;
};

// What of the domain a capture can fill: with the view fixed, thetaD is half the light's polar angle.
TableDomain capturedDomain(const std::vector<Light>& lights, int coordinates);

// What of the domain a table is to span.
TableDomain tableDomain(const std::vector<Light>& lights, TableRange range, int coordinates);

// Over thetaH and phiD as brdf_samples.h has it, one a degree over thetaD. Natural: 90 x 90 x 90.
glm::ivec3 tableSize(const TableDomain& domain);

// Half of them: for a table of a few thousand samples, or one that others are made by.
glm::ivec3 coarseTableSize(const TableDomain& domain);

struct BakedBrdf {
    BrdfTable table; // confidence 1 where a sample lies within one texel's diagonal, falling as the distance grows
    Coverage coverage;
};

// samples: those that the interpolant was made of.
BakedBrdf bakeBrdf(const BrdfSamples& samples, const BrdfInterpolant& interpolant, const BakeOptions& options);
BakedBrdf bakeBrdf(const BrdfSamples& samples, const InterpolationOptions& interpolation, const BakeOptions& options);

} // namespace nacre
