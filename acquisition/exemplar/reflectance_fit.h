#pragma once
#include <vector>

#include "acquisition/exemplar/ball_match.h"

namespace nacre {

// The object's own reflectance from its pixels' matches under `model`, of the form asked for, and the albedos that its
// well explained pixels have. The reflectance's scale goes into the matches' scales: its diffuse part is 1 at
// n.l = 0.8 (additive), its lobe 1 in the middle of thetaH 40 to 70 degrees (multiplicative); without that, albedo and
// reflectance could grow against each other. `model`'s ball is left as it is.
void fitReflectance(const PixelLattice& lattice, bool additive, int threads, MatchModel& model,
                    std::vector<BallMatch>& matches);

// The same, with the ball of the new reflectance; the matches' costs are not known any more.
void refitModel(const PixelLattice& lattice, bool additive, int threads, MatchModel& model,
                std::vector<BallMatch>& matches);

} // namespace nacre
