#pragma once
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// Grey f(n, l, v = (0,0,1)) of a candidate reflectance.
using GreyReflectance = std::function<float(const glm::vec3& n, const glm::vec3& l)>;

// The reference balls of one reflectance, one per light of the capture, turned around: for each texel of the disc of
// normals the column f(n, l_i, v) max(0, n.l_i) over the lights, which is what a pixel with that normal shows, up to
// its albedo. Columns are padded with zeros to a multiple of eight.
struct PredictedBall {
    int size = 0; // texels across the disc
    size_t lightCount = 0;
    size_t stride = 0;
    std::vector<int> rows;          // size x size: index of the texel's column, -1 beyond the rim
    std::vector<glm::vec3> normals; // per column
    std::vector<float> columns;     // [row * stride + light]
    std::vector<float> roots;       // their square roots

    const float* column(int row) const { return &columns[row * stride]; }
    // The row whose texel holds the normal, or its nearest inside the rim.
    int rowOf(const glm::vec3& normal) const;
    // The four columns around a normal, bilinearly mixed; rowOf's at the rim, where one of them is missing. `mixed` has
    // stride floats.
    void mixColumns(const glm::vec3& normal, float* mixed) const;
};

// A place on the ball between four columns.
struct BallCell {
    std::array<const float*, 4> columns{}; // of the texels (x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)
    float u = 0, v = 0;                    // from x and y on, [0, 1]
};

// Texel coordinates, (0, 0) at the centre of the top left texel, and back.
glm::vec2 ballTexelOf(const glm::vec3& normal, int size);
glm::vec3 normalOfBallTexel(const glm::vec2& texel, int size);

// Empty at the rim.
std::optional<BallCell> findBallCell(const PredictedBall& ball, const glm::vec2& texel);

PredictedBall makePredictedBall(int size, const std::vector<glm::vec3>& directions, const GreyReflectance& reflectance,
                                int threads);

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
