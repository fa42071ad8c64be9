#pragma once
#include <limits>
#include <vector>

#include "acquisition/exemplar/predicted_ball.h"

namespace nacre {

// The scales (albedos) that an exemplar may have: free, or close to the object's common one.
struct ScaleRange {
    float low = 0;
    float high = std::numeric_limits<float>::max();

    bool isFree() const { return high == std::numeric_limits<float>::max(); }
};

// A pixel as matching sees it: padded observations, their square roots (for free scales; null otherwise), their
// weights (0 leaves a light out), and the residual beyond which an observation costs no more.
struct MatchTarget {
    const float* observed;
    const float* roots;
    const float* weights;
    float limit;
};

// The mean over the lights of the residual |I - scale P|, truncated, in units of the limit: [0,1]. It forgets cast
// shadows and highlights that the reflectance does not know.
struct Match {
    float cost = 2;
    float scale = 0;
    int row = -1; // of the ball
};

// The scale, of a bounded range, that suits a column of predictions.
float fittedScale(const float* column, size_t stride, const MatchTarget& target, const ScaleRange& range);

// The best column of the ball within the angle of `start`, cosine given.
Match findBestMatch(const PredictedBall& ball, const MatchTarget& target, const glm::vec3& start, float cosRadius,
                    const ScaleRange& range);

// The normal between the texels: the minimum of a parabola through the costs of the match's neighbours.
glm::vec3 refinedNormal(const PredictedBall& ball, const MatchTarget& target, const Match& match,
                        const ScaleRange& range);

// The cost of predictions scale * column against observations that `weights` names.
float matchCost(const float* column, size_t stride, const MatchTarget& target, float scale);

} // namespace nacre
