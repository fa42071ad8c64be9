#pragma once
#include <vector>

#include "engine/brdf/brdf_table.h"

namespace nacre {

struct LobeSample {
    float angle = 0; // radians from the normal in the plane of incidence, positive on the side away from the light
    glm::vec3 f{0};  // 1/sr without the cosine
    bool isMeasured = false;
};

// f(n, l, v) for light from `incidence` radians and `count` viewers over the plane of incidence, horizon to horizon.
std::vector<LobeSample> sampleLobe(const BrdfTable& table, float incidence, int count);

} // namespace nacre
