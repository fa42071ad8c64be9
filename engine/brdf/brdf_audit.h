#pragma once
#include <vector>

#include "engine/brdf/brdf_comparison.h"

namespace nacre {

// What a white furnace shows: the share of the light from v that is reflected, the integral of f n.l over l.
struct DirectionalAlbedo {
    double thetaDegrees = 0; // of v
    glm::vec3 albedo{0};
    double covered = 0; // share of the cosine-weighted hemisphere of l with coverage; the rest is counted as it is
};

// Is f what a real material's could be? Over comparisonConfigurations where f is covered both ways round.
struct BrdfAudit {
    size_t configurations = 0;
    // |f(l,v) - f(v,l)| / max(their mean, 1 % of the peak), channels pooled.
    double reciprocityMedian = 0, reciprocity95 = 0, reciprocityMost = 0;
    size_t negative = 0;  // configurations with a channel below 0
    size_t notFinite = 0; // with NaN or infinity; left out of all the rest
    glm::vec3 least{0}, most{0};
    std::vector<DirectionalAlbedo> albedos; // kAuditDegrees
    double largestAlbedo = 0;               // of any channel; above 1, energy is made
};

inline constexpr double kAuditDegrees[] = {0, 15, 30, 45, 60, 75};

BrdfAudit auditBrdf(const BrdfFunction& f, int threads = 0, size_t count = 200000);

DirectionalAlbedo directionalAlbedo(const BrdfFunction& f, double thetaDegrees);

} // namespace nacre
