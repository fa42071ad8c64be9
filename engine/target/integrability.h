#pragma once
#include "engine/surface/normal_map.h"

namespace nacre {

// Whether normals are those of a height: then the slope across grows upwards as the slope upwards grows across,
// dp/dy = dq/dx. A green that points the wrong way turns that into dp/dy = -dq/dx.
enum class GreenVerdict {
    agrees,
    flipped,
    undecided // flat, cylindrical or too noisy: both ways explain the map alike
};

struct Integrability {
    GreenVerdict verdict = GreenVerdict::undecided;
    // Mean |dp/dy - dq/dx| as the map is over the same with green flipped, at the scale where they differ most.
    double residualRatio = 1;
};

Integrability checkIntegrability(const NormalMap& map);

} // namespace nacre
