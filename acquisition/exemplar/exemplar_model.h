#pragma once
#include <memory>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/exemplar/held_out_lights.h"
#include "acquisition/exemplar/neighbour_search.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// What explains one object under one set of lights: its reflectance, and the matches of a thin lattice of its pixels.
struct ExemplarModel {
    std::unique_ptr<const BallGrid> grid; // stays in its place when this moves
    MatchModel match;
    PixelLattice lattice;
    std::vector<BallMatch> matches;
    std::vector<int> nearest;         // see nearestPixels
    float typicalCost = 1;            // of a match, in the median
    std::vector<float> heldOutErrors; // per pixel of the jury's lattice, before the other lights were seen
};

// Hypotheses on the coarsest level; the one that predicts the lights best which the jury holds out (null: the one of
// least cost) goes down to the lattice, and is then improved under all lights, reflectance and normals at once in the
// end. Findings say what was chosen. `sample`: pixels from all over the object.
ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, const Jury* jury, std::vector<Finding>& findings);

// Matches of any pixels of the object: candidates are the nearest ones of the lattice and steps from the best of
// them. Every pixel by itself, so that it does not matter which ones are asked for at once.
std::vector<BallMatch> matchPixels(const ExemplarModel& model, const PixelLattice& pixels, int threads);

} // namespace nacre
