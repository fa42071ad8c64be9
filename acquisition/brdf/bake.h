#pragma once
#include "acquisition/brdf/interpolation.h"
#include "engine/scene/brdf_table.h"
#include "engine/scene/light.h"

namespace nacre {

struct BakeOptions {
    int coordinates = kHalfDifference;
    // Texels; 0: from the domain, see tableSize.
    glm::ivec3 size{0};
    int threads = 0;
};

// What of the domain a capture can fill: with the view fixed, thetaD is half the light's polar angle.
TableDomain capturedDomain(const std::vector<Light>& lights, int coordinates);

// 90 texels over thetaH (MERL's density), one a degree over thetaD, one every two degrees over the folded phiD.
// Natural: 90 x 90 x 90.
glm::ivec3 tableSize(const TableDomain& domain);

struct BakedBrdf {
    BrdfTable table; // confidence 1 where a sample lies within one texel's diagonal, falling as the distance grows
    Coverage coverage;
};

BakedBrdf bakeBrdf(const BrdfSamples& samples, const InterpolationOptions& interpolation, const BakeOptions& options);

} // namespace nacre
