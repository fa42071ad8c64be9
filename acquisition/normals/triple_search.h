#pragma once
#include <vector>

#include "acquisition/normals/intensities.h"
#include "acquisition/normals/light_triples.h"

namespace nacre {

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
