#pragma once
#include <array>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

namespace nacre {

// What of some pixels' albedo factors goes with n.v, channel by channel. Paint knows nothing of slopes: where most of
// the factors' spread goes with n.v, that part is how the one material looks from aside, and belongs to its BRDF.
class SlopeTrend {
public:
    // Factors without a positive channel take no part. `cosines`: n.v, one a factor. None where less than three
    // quarters of the spread's square goes with n.v, over all channels, or where too few factors tell.
    static std::optional<SlopeTrend> of(std::span<const glm::vec3> factors, std::span<const float> cosines);

    // The factor's part that goes with n.v, its median over the pixels 1.
    glm::vec3 at(float cosine) const;

private:
    static constexpr int kBins = 16; // of n.v from 0 to 1

    std::array<glm::vec3, kBins> logs_{}; // in the bins' middles
};

} // namespace nacre
