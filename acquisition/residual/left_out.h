#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "acquisition/capture/observation_blocks.h"
#include "acquisition/residual/residual_choice.h"
#include "acquisition/residual/residual_rows.h"

namespace nacre {

inline constexpr size_t kFewestResidualLights = 6; // three for the plane through them, as many again to judge it

// A picture of one row, the sample's pixels, as they would be measured without the lights named.
using Remeasure = std::function<Surface(const Observations& sample, std::span<const size_t> without)>;

// A sample of a finished surface's pixels, and what is said of each light by a BRDF, normals and albedo that have not
// seen its photograph.
struct LeftOut {
    std::string whyNot; // where lights cannot tell; the rest is empty then
    size_t shadedPixels = 0;
    ResidualRows rows;
    UnseenRows unseen;
};

// Walks the blocks, whose lights are the surface's, once. Up to twelve lights are left out one by one, more by sixths.
LeftOut leaveOut(const Surface& surface, ObservationBlocks& blocks, const Remeasure& remeasure);

std::vector<glm::vec3> lightDirections(const Surface& surface);

ResidualJudge judgeOf(const Surface& surface, const ResidualRows& rows);

} // namespace nacre
