#pragma once
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

#include "acquisition/normals/intensities.h"
#include "engine/lights/light.h"

namespace nacre {

// Three lights and the inverse of their directions: rho n = inverse * (I_a, I_b, I_c).
struct LightTriple {
    int a, b, c;
    glm::mat3 inverse;
};

std::vector<glm::vec3> directionsOf(const std::vector<Light>& lights);

// All C(n,3) triples that span space where there are at most `most`; else that many, drawn with a fixed seed from the
// better conditioned half. Depends on the lights alone, so it is made once per light set.
std::vector<LightTriple> makeLightTriples(const std::vector<Light>& lights, size_t most, uint64_t seed);

// How a triple's line is judged against all observations of the pixel.
enum class TripleCost {
    sumOfDistances, // the paper's RANSAC: |I - g.l| over all lights
    truncated,      // min(|I - max(0, g.l)|, limit): an attached shadow is explained, an outlier costs no more than the
                    // limit
};

// For each pixel the g = rho n of the triple with the least cost; z > 0 always, and g = 0 where no triple had it. The
// truncated cost's limit is `limitShare` of the pixel's bright level.
std::vector<glm::vec3> findBestTriples(const Intensities& intensities, const std::vector<LightTriple>& triples,
                                       const std::vector<glm::vec3>& directions, TripleCost cost, float limitShare,
                                       int threads);

} // namespace nacre
