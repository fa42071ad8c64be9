#pragma once
#include <filesystem>

#include <glm/vec3.hpp>

#include "acquisition/sphere_outline.h"
#include "engine/scene/image.h"

namespace nacre {

// Which of the diffuse sphere's pixels speak of the light (Wu et al., section 3.2). The paper's rule 2 removes angles
// *above* t3, but says that it removes highlights: those lie where the mirrored light meets the view, at small angles.
struct DiffuseSphereRules {
    float nDotLMin = 0.2f;          // t1: grazing pixels are sensitive to the outline
    float nDotLMax = 0.98f;         // t2
    float highlightDegrees = 15.0f; // t3: least angle between view and mirrored light
    float darkShare = 0.1f;         // t4: of the photograph's 99th percentile on the sphere
};

struct DiffuseSphereReading {
    glm::vec3 radiance{0};         // E rho / pi per channel: radiance of a patch that faces the light
    glm::vec3 shadingDirection{0}; // unit: the light's direction by the sphere's own shading
    float offset = 0;              // constant that the shading fit found, in the photograph's units
    size_t pixels = 0;             // used
    size_t rejected = 0;
};

// Eq. 2, sum I / sum n.l, over the pixels that the rules leave and whose ratio lies within three robust standard
// deviations of the median. Throws Error where too few are left.
DiffuseSphereReading readDiffuseSphere(const Image& photograph, const Circle& outline, const glm::vec3& lightDirection,
                                       const std::filesystem::path& source, const DiffuseSphereRules& rules = {});

} // namespace nacre
