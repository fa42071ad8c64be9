#pragma once
#include <array>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "acquisition/capture/finding.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// Whether normals are those of a height, which lights that all err alike undo: dp/dy = dq/dx, p = n.x/n.z, q = n.y/n.z.
struct HeightConsistency {
    size_t places = 0; // pixels with neighbours on all sides
    // Mean |dp/dy - dq/dx| over the same with the axes as each of kAxes has them: well below 1, above it where the
    // lights' axes are so. Both axes reversed make a height of any height: hollows for bumps.
    std::array<double, 3> axesRatios{};
    // How far all normals have to be turned about x and y to be those of a height. A height tilted as a whole stays
    // one; what tells the turn is its other half, n.z growing with n.x and n.y.
    glm::dvec2 turnDegrees{0};
    double turnedRatio = 1; // of mean |dp/dy - dq/dx|, turned so, over as it is
};
HeightConsistency heightConsistencyOf(const NormalMap& map);

// By how much better, from which on axes are said to be mixed up.
inline constexpr double kMixedAxes = 1.33;

// A warning where the lights' axes must be mixed up, or all lights turned; a remark where they may be reversed.
SelfChecks checkHeight(const NormalMap& map);

} // namespace nacre
