#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/normals/normals.h"
#include "shared/brdf_coords.h"

namespace nacre {

// M observations of one material.
struct BrdfSamples {
    TableDomain domain;
    std::vector<glm::vec3> unit;   // coordinates on the table's unit cube (brdf_coords.h)
    std::vector<glm::vec3> values; // f in 1/sr, up to the capture's scale factor
    std::vector<float> weights;    // trust, > 0

    size_t size() const { return values.size(); }
};

// Those with a positive weight and finite numbers. Throws Error where none is left.
BrdfSamples usableSamples(const BrdfSamples& samples);

struct SampleOptions {
    // Rejected below: at grazing light f = I / (E n.l) divides noise by little.
    float leastCosine = 0.1f;
    // At most this many samples; pixels are thinned evenly by a hash of their position.
    size_t most = 400000;
    int threads = 0;
};

struct SampleCounts {
    size_t used = 0;
    size_t shadowed = 0; // attached, cast or grazing
    size_t saturated = 0;
    size_t withoutNormal = 0; // observations of pixels that have none
    size_t thinned = 0;       // left out because `most` was reached
};

// Adds f_i = I_i / (a_p E_i n.l_i) of a block's pixels with their albedo factors a_p, v = (0,0,1). `share` of the
// pixels is kept, so that the capture's total stays below `most`. Verdicts are obeyed: nothing in shadow and nothing
// saturated goes in.
void gatherSamples(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                   const std::vector<Light>& lights, double share, const SampleOptions& options, BrdfSamples& samples,
                   SampleCounts& counts);

} // namespace nacre
