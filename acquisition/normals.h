#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "acquisition/observations.h"
#include "engine/scene/light.h"

namespace nacre {

enum class NormalMethod { leastSquares, threshold };

// "least-squares", "threshold"; throws a usage Error that lists the names.
NormalMethod normalMethodFromName(const std::string& name);
std::string nameOf(NormalMethod method);

struct NormalOptions {
    NormalMethod method = NormalMethod::leastSquares;
    // threshold: observations outside are dropped. In radiance over irradiance, grey, if both are set (0 <= low <
    // high); otherwise the darkest and brightest shares of each pixel's own observations.
    float lowThreshold = -1;
    float highThreshold = -1;
    float darkestShare = 0.2f;
    float brightestShare = 0.25f;
    int threads = 0;
};

// Grey of linear Rec. 601 weights, as DiLiGenT's published figures use it.
inline float greyOf(const glm::vec3& rgb)
{
    return 0.2989f * rgb.x + 0.5870f * rgb.y + 0.1140f * rgb.z;
}

// What photometric stereo says of one pixel.
struct PixelNormal {
    glm::vec3 normal{0};  // unit, camera frame; 0 where there is none
    float albedo = 0;     // rho of I / E = rho n.l, grey
    float confidence = 0; // [0,1]; 0 = no data
    uint16_t used = 0;    // observations that the estimate rests on
};

// Normals of a block's pixels, in the block's order, from observations divided by their light's irradiance.
std::vector<PixelNormal> estimateNormals(const Observations& block, const std::vector<Light>& lights,
                                         const NormalOptions& options);

// Woodham, Photometric method for determining surface orientation from multiple images, 1980, by the singular value
// decomposition of the light directions that `use` keeps (empty: all): rho n minimises |I - L^T rho n|.
class LambertianSolver {
public:
    explicit LambertianSolver(const std::vector<Light>& lights);
    ~LambertianSolver();
    PixelNormal solve(std::span<const float> intensities) const;
    PixelNormal solve(std::span<const float> intensities, std::span<const uint8_t> use) const;

private:
    struct Decomposition;
    std::unique_ptr<Decomposition> all_;
    std::vector<glm::vec3> directions_;
};

} // namespace nacre
