#include "engine/scene/coverage.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "shared/shading.h"

namespace nacre {
namespace {

constexpr size_t kMostPairs = 4'000'000; // of pixel and light: a fraction of a second
constexpr size_t kLeastPixels = 400;
constexpr size_t kGrain = 64; // pixels of one partial sum

// Whether anything of the material's can be uncertain.
bool canBeUncertain(const Material& material)
{
    const BrdfTable& table = material.table;
    if (!knowsCoverage(table)) {
        return false;
    }
    if (table.domain.coordinates != kNatural && table.domain.thetaDMax < kHalfPi) {
        return true;
    }
    for (size_t texel = 0; texel < table.values.size(); ++texel) {
        if (expectedError(table, texel) > kUncertainError) {
            return true;
        }
    }
    return false;
}

// At most so many of the pixels that are shaded and face the viewer, evenly spread in reading order.
std::vector<size_t> facingPixels(const Surface& surface, const glm::vec3& view, size_t most)
{
    std::vector<size_t> all;
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (isShaded(surface, i) && glm::dot(surface.normals.normals[i], view) > 0) {
            all.push_back(i);
        }
    }
    const size_t count = std::min(all.size(), most);
    for (size_t i = 0; i < count; ++i) {
        all[i] = all[i * all.size() / count];
    }
    all.resize(count);
    return all;
}

} // namespace

bool knowsCoverage(const BrdfTable& table)
{
    return !table.error.empty() ||
           std::any_of(table.confidence.begin(), table.confidence.end(), [](float c) { return c > 0; });
}

float expectedError(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v)
{
    return errorWithinTable(sampleError(table, unitFromDirections(table.domain, n, l, v)),
                            halfDifferenceFromDirections(n, l, v).thetaD, table.domain.coordinates,
                            table.domain.thetaDMax);
}

PixelCertainty certaintyOf(const Surface& surface, size_t pixel, const PixelLights& lights)
{
    const glm::vec3 view = lights.view(pixel);
    const glm::vec3& n = surface.normals.normals[pixel];
    const BrdfTable& table = surface.materials[surface.labels[pixel]].table;
    PixelCertainty certainty;
    float beyond = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        const PixelLights::Met met = lights.at(i, pixel);
        const glm::vec3& l = met.light.direction;
        const float nDotL = glm::dot(n, l);
        if (nDotL > 0 && met.share > 0 && met.light.irradiance != glm::vec3(0)) {
            const glm::vec3 f = evaluateTable(table, n, l, view).value;
            beyond += errorBeyondBound(expectedError(table, n, l, view),
                                       met.share * radianceFromBrdf(f, met.light.irradiance, nDotL));
            certainty.isLit = true;
        }
    }
    certainty.isUncertain = beyond > 0;
    return certainty;
}

double uncertainShare(const Surface& surface, std::span<const Light> lights, const glm::vec3& view, size_t mostPairs,
                      int threads)
{
    std::vector<uint8_t> canBe;
    for (const Material& material : surface.materials) {
        canBe.push_back(canBeUncertain(material));
    }
    if (lights.empty() || std::count(canBe.begin(), canBe.end(), 1) == 0) {
        return 0;
    }
    const std::vector<size_t> pixels = facingPixels(surface, view, std::max(kLeastPixels, mostPairs / lights.size()));
    const PixelLights met(surface, lights, view);
    std::vector<size_t> lit(pixels.size() / kGrain + 1), uncertain(lit.size());
    parallelFor(pixels.size(), kGrain, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const PixelCertainty pixel = certaintyOf(surface, pixels[i], met);
            lit[first / kGrain] += pixel.isLit;
            uncertain[first / kGrain] += pixel.isUncertain && canBe[surface.labels[pixels[i]]];
        }
    });
    const auto sum = [](const std::vector<size_t>& counts) {
        return static_cast<double>(std::accumulate(counts.begin(), counts.end(), size_t{0}));
    };
    return sum(uncertain) / std::max(1.0, sum(lit));
}

double uncertainShare(const Scene& scene, int threads)
{
    return uncertainShare(scene.surface, scene.lights, scene.view, kMostPairs, threads);
}

std::string describeUncertainShare(double share)
{
    if (share <= 0) {
        return "";
    }
    const std::string percent = share < 0.001 ? "below 0.1 %" : fmt::format("{:.1f} %", 100 * share);
    return fmt::format("{} of this picture is uncertain by more than {:.0f} %", percent, 100 * kUncertainError);
}

} // namespace nacre
