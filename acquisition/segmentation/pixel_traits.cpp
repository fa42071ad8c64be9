#include "acquisition/segmentation/pixel_traits.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr float kLeastTraitCosine = 0.2f;
constexpr size_t kFewestTraitLit = 3;
constexpr double kDarkest = 0.1, kMatte = 0.55; // shares of the lit observations, by f

struct LitObservation {
    float f = 0;           // grey
    glm::vec3 radiance{0}; // over irradiance
    float thetaH = 0;      // degrees
};

float halfAngleDegrees(const glm::vec3& n, const glm::vec3& l)
{
    const glm::vec3 h = glm::normalize(l + glm::vec3(0, 0, 1));
    return glm::degrees(std::atan2(glm::length(glm::cross(n, h)), glm::dot(n, h)));
}

// By f, ascending.
std::vector<LitObservation> litObservations(const Observations& block, const NormalBlock& normals, size_t p,
                                            const std::vector<Light>& lights)
{
    std::vector<LitObservation> lit;
    const glm::vec3& n = normals.pixels[p].normal;
    for (size_t i = 0; i < lights.size(); ++i) {
        const Verdict verdict = normals.verdicts[p * lights.size() + i];
        const float nDotL = glm::dot(n, lights[i].direction);
        const glm::vec3 radiance = block.radianceOf(p)[i] / lights[i].irradiance;
        const bool isLit = verdict != Verdict::shadow && verdict != Verdict::saturated && nDotL > kLeastTraitCosine;
        if (isLit && greyOf(radiance) > 0) {
            lit.push_back({greyOf(radiance) / nDotL, radiance, halfAngleDegrees(n, lights[i].direction)});
        }
    }
    std::stable_sort(lit.begin(), lit.end(), [](const auto& a, const auto& b) { return a.f < b.f; });
    return lit;
}

glm::vec2 chromaticityOf(const glm::vec3& rgb)
{
    const float sum = rgb.x + rgb.y + rgb.z;
    return sum > 0 ? glm::vec2(rgb.x, rgb.y) / sum : glm::vec2(1.0f / 3);
}

void takeMatte(std::span<const LitObservation> matte, PixelTraits& traits)
{
    glm::vec3 sum(0);
    for (const LitObservation& seen : matte) {
        sum += seen.radiance;
    }
    traits.chromaticity = chromaticityOf(sum);
    std::vector<float> misses;
    for (const LitObservation& seen : matte) {
        misses.push_back(glm::distance(chromaticityOf(seen.radiance), traits.chromaticity));
    }
    traits.chromaticityError = quantile(misses, 0.5) / std::sqrt(static_cast<float>(matte.size()));
    traits.logAlbedo = std::log(matte[matte.size() / 2].f);
}

void takeLobe(std::span<const LitObservation> lit, PixelTraits& traits)
{
    std::array<float, kLobeBins> sum{}, count{};
    for (const LitObservation& seen : lit) {
        const int bin = static_cast<int>(seen.thetaH / kLobeBinDegrees);
        if (bin < kLobeBins) {
            sum[bin] += seen.f;
            ++count[bin];
        }
    }
    for (int bin = 0; bin < kLobeBins; ++bin) {
        if (count[bin] > 0) {
            traits.lobe[bin] = std::log(sum[bin] / count[bin]) - traits.logAlbedo;
            traits.lobeSeen |= static_cast<uint16_t>(1u << bin);
        }
    }
}

// False where too little is lit.
bool traitsOf(std::span<const LitObservation> lit, PixelTraits& traits)
{
    if (lit.size() < kFewestTraitLit) {
        return false;
    }
    const size_t first = static_cast<size_t>(kDarkest * static_cast<double>(lit.size()));
    const size_t last = std::max(static_cast<size_t>(kMatte * static_cast<double>(lit.size())), first + 2);
    takeMatte(lit.subspan(first, last - first), traits);
    takeLobe(lit, traits);
    return true;
}

} // namespace

std::vector<PixelTraits> pixelTraits(const Observations& block, const NormalBlock& normals,
                                     const std::vector<Light>& lights, int threads)
{
    std::vector<PixelTraits> traits(block.pixels.size());
    std::vector<uint8_t> known(traits.size(), 0);
    parallelFor(traits.size(), 256, threads, [&](size_t begin, size_t end) {
        for (size_t p = begin; p < end; ++p) {
            traits[p].pixel = block.pixels[p];
            known[p] =
                normals.pixels[p].confidence > 0 && traitsOf(litObservations(block, normals, p, lights), traits[p]);
        }
    });
    size_t kept = 0;
    for (size_t p = 0; p < traits.size(); ++p) {
        if (known[p]) {
            traits[kept++] = traits[p];
        }
    }
    traits.resize(kept);
    return traits;
}

} // namespace nacre
