#pragma once
#include "acquisition/brdf/interpolation.h"

namespace nacre {

// Samples of some photographs, to be predicted from those of the others.
struct HeldOutPlanes {
    BrdfSamples kept, judges;
    std::vector<float> cosines; // n.l of the judges
    float peak = 1;             // 99th percentile of all f n.l
    bool areLights = false;     // else too few photographs to hold any out, and single samples are
};

// Every sixth plane of thetaD, neither the first nor the last: under distant lights a photograph each, under near ones
// a slice of several. Of natural coordinates planes of thetaO. Every sixth sample where there are few planes. cells:
// condensed samples.
HeldOutPlanes holdOutPlanes(const BrdfSamples& cells);

// Root mean square error of the judges' f n.l over `peak`, clipped beyond it, each by the squares of its trust and its
// pixels' albedo: as photographs show it.
double errorOf(const HeldOutPlanes& split, const BrdfInterpolant& interpolant, int threads);

} // namespace nacre
