#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "acquisition/normals/normals.h"

namespace nacre {

// Woodham, Photometric method for determining surface orientation from multiple images, 1980, by the singular value
// decomposition of the light directions: rho n minimises |I - L^T rho n|. Confidence follows from the residual and
// the lights that are left; it is 0 where those are fewer than three or do not span space.
class LambertianSolver {
public:
    explicit LambertianSolver(const std::vector<Light>& lights);
    ~LambertianSolver();
    LambertianSolver(LambertianSolver&&) noexcept;
    PixelNormal solve(std::span<const float> intensities) const;
    // Observations weigh `weights` >= 0 each.
    PixelNormal solve(std::span<const float> intensities, std::span<const float> weights) const;
    // v.l per light.
    void project(const glm::vec3& v, std::span<float> dots) const;
    // rho max(0, n.l) per light.
    void predict(const PixelNormal& pixel, std::span<float> predicted) const;

private:
    struct Decomposition;
    std::unique_ptr<Decomposition> all_;
    std::vector<glm::vec3> directions_;
    std::vector<float> x_, y_, z_; // of them, padded with zeros to whole lanes
};

// Fills a block pixel by pixel with `solve(pixel, intensities)` and judges its observations by the Lambertian
// prediction.
NormalBlock solveBlock(const Intensities& intensities, const LambertianSolver& solver, int threads,
                       const std::function<PixelNormal(size_t, std::span<const float>)>& solve);

} // namespace nacre
