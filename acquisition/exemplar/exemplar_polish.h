#pragma once
#include "acquisition/exemplar/exemplar_match.h"

namespace nacre {

// A match between the ball's texels.
struct PolishedMatch {
    glm::vec3 normal{0}; // unit
    float scale = 0;
};

// The normal and the scale that predict the pixel best near a match, on columns interpolated bilinearly: Gauss-Newton
// steps on residuals whose weights fall linearly to zero at the target's limit. Without it normals and albedo keep the
// grid of the ball. Starts at `normal`, which must lie within a texel of the match.
PolishedMatch polishedMatch(const PredictedBall& ball, const MatchTarget& target, const Match& match,
                            const glm::vec3& normal, const ScaleRange& range);

} // namespace nacre
