#pragma once
#include <cstdint>
#include <filesystem>
#include <span>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "acquisition/lights/sphere_outline.h"
#include "engine/files/image.h"

namespace nacre {

// Which of the diffuse sphere's pixels speak of the light (Wu et al., section 3.2). The paper's rule 2 removes angles
// *above* t3, but says that it removes highlights: those lie where the mirrored light meets the view, at small angles.
struct DiffuseSphereRules {
    float nDotLMin = 0.2f;          // t1: grazing pixels are sensitive to the outline
    float nDotLMax = 0.98f;         // t2
    float highlightDegrees = 15.0f; // t3: least angle between view and mirrored light
    float darkShare = 0.1f;         // t4: of the photograph's 99th percentile on the sphere
};

// Sums over the pixels of a shading fit I = g.n + offset, from which its least squares follow.
struct ShadingSums {
    glm::dmat3 normalProducts{0};  // sum n n^T
    glm::dvec3 normals{0};         // sum n
    glm::dvec3 radianceNormals{0}; // sum I n
    double radiance = 0;           // sum I
    double count = 0;
};

struct DiffuseSphereReading {
    glm::vec3 radiance{0};         // E rho / pi per channel: radiance of a patch that faces the light
    glm::vec3 shadingDirection{0}; // unit: the light's direction by the sphere's own shading
    float offset = 0;              // constant beneath the shading, in the photograph's units
    float shadowLevel = 0;         // median of the pixels that face away from the light, of which there are
    size_t shadowPixels = 0;
    ShadingSums sums;  // of the shading fit
    size_t pixels = 0; // used
    size_t rejected = 0;
};

// Eq. 2, sum I / sum n.l, over the pixels that the rules leave and whose ratio lies within three robust standard
// deviations of the median. Throws Error where too few are left.
DiffuseSphereReading readDiffuseSphere(const Image& photograph, const Circle& outline, const glm::vec3& lightDirection,
                                       const std::filesystem::path& source, const DiffuseSphereRules& rules = {},
                                       std::span<const uint8_t> saturated = {});

// Fits all photographs again with one offset in common: the level of their attached shadows, which light alone cannot
// raise, or where none is seen the offset that fits the lit parts of all best. The lit part alone tells an offset badly
// from a reflectance that is not quite Lambert's, and a wrong one turns the fit away from the view.
void shareOffset(std::span<DiffuseSphereReading> readings);

} // namespace nacre
