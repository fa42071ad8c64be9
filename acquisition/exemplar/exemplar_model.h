#pragma once
#include <memory>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/exemplar/neighbour_search.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// What explains one object under one set of lights: its reflectance, and the matches of a thin lattice of its pixels.
struct ExemplarModel {
    std::unique_ptr<const BallGrid> grid; // stays in its place when this moves
    MatchModel match;
    PixelLattice lattice;
    int spacing = 1; // of the lattice, in pixels
    std::vector<BallMatch> matches;
};

// Hypotheses on the coarsest level (Lambert's law or a known reflectance to start from, gloss scaled by the albedo or
// common to the object), each of which finds the object's own reflectance and its normals in turn; the one of least
// cost goes on to the lattice. Findings say what was chosen. `sample`: pixels from all over the object.
ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, std::vector<Finding>& findings);

// Matches of any pixels of the object: candidates are those of the lattice around a pixel and steps from the best of
// them. Every pixel by itself, so that it does not matter which ones are asked for at once.
std::vector<BallMatch> matchPixels(const ExemplarModel& model, const PixelLattice& pixels, int threads);

} // namespace nacre
