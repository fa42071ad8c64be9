#pragma once
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>

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

} // namespace nacre
