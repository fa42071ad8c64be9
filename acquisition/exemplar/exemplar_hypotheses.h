#pragma once
#include <string>
#include <vector>

#include "acquisition/exemplar/ball_match.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// One way to explain an object: its own reflectance, found in turn with its normals from a start that is named.
struct Hypothesis {
    std::string name;
    MatchModel model;
    std::vector<BallMatch> matches;
    double cost = 0; // mean of the matches'
};

// Two of them, on a coarse lattice under the grid's lights, from the known reflectance that explains it best: gloss
// scaled by the albedo, and from there gloss common to the object. `grid` has to outlive them.
std::vector<Hypothesis> makeHypotheses(const BallGrid& grid, const PixelLattice& lattice,
                                       const std::vector<Light>& lights, const NormalOptions& options);

} // namespace nacre
