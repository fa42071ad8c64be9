#pragma once
#include <span>
#include <vector>

#include "acquisition/exemplar/ball_match.h"

namespace nacre {

// After Barnes, Shechtman, Finkelstein, Goldman, PatchMatch, 2009, and Bleyer, Rhemann, Rother, PatchMatch Stereo,
// 2011: what explains a pixel is likely to explain the one beside it.

// One sweep over all pixels, the black squares of a chessboard and then the white ones, so that the result does not
// depend on the order within a colour. Candidates are the pixel's own match, its four neighbours', `extra` (places on
// the ball, one a pixel; may be empty), and steps of so many texels in four directions. Nothing couples neighbours but
// that: the cost is the pixel's own, so nothing is smoothed.
void sweepMatches(const MatchModel& model, const PixelLattice& lattice, const std::vector<int>& steps,
                  std::span<const glm::vec2> extra, int threads, std::vector<BallMatch>& matches);

// The best of the candidates and of steps from it, polished. No row of the ball is tried twice.
BallMatch bestMatch(const MatchModel& model, const PixelLattice& lattice, size_t pixel,
                    std::span<const BallMatch> candidates, const std::vector<int>& steps);

void polishMatches(const MatchModel& model, const PixelLattice& lattice, int threads, std::vector<BallMatch>& matches);

} // namespace nacre
