#pragma once
#include "acquisition/residual/light_balls.h"
#include "acquisition/residual/residual_choice.h"
#include "engine/surface/surface.h"

namespace nacre {

// Turns photographs, block by block, into a layer's component pictures of 8 bits, and its basis into splines.
class ResidualEncoder {
public:
    // `sample` sets the range of each component, with a reserve; what lies beyond is clamped. `basis`: orthonormal
    // columns over [channel * lights + light]. Surface and balls are referred to while the encoder lives.
    ResidualEncoder(const Surface& surface, const LightBalls& balls, const std::vector<glm::vec2>& nodes,
                    const ResidualFit& fit, const ResidualRows& sample, Eigen::MatrixXf basis);

    void encode(const Observations& block, int threads);

    ResidualLayer layer;

private:
    void encodePixels(const Observations& block, std::span<const size_t> places);

    const Surface& surface_;
    const LightBalls& balls_;
    Eigen::MatrixXf basis_;
};

} // namespace nacre
