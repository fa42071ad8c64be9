#include "acquisition/brdf/albedo_factor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <glm/geometric.hpp>

#include "acquisition/brdf/pixel_prediction.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

glm::vec3 colourOf(std::span<const glm::vec3> radiance, const Verdict* verdicts, const std::vector<Light>& lights)
{
    glm::vec3 sum(0);
    for (size_t i = 0; i < lights.size(); ++i) {
        if (verdicts[i] == Verdict::used) {
            sum += radiance[i] / lights[i].irradiance;
        }
    }
    const float grey = greyOf(sum);
    return grey > 0 ? sum / grey : glm::vec3(0);
}

constexpr int kRefitRounds = 4;

glm::vec3 refittedFactor(const PixelPrediction& pixel, glm::vec3 factor)
{
    for (int round = 0; round < kRefitRounds; ++round) {
        glm::vec3 up(0), down(0);
        for (size_t i = 0; i < pixel.observed.size(); ++i) {
            const float miss = std::abs(greyOf(pixel.observed[i] - factor * pixel.predicted[i]));
            const float weight = std::max(0.0f, 1 - miss / pixel.limit);
            up += weight * pixel.observed[i] * pixel.predicted[i];
            down += weight * pixel.predicted[i] * pixel.predicted[i];
        }
        for (int c = 0; c < 3; ++c) {
            factor[c] = up[c] > 0 && down[c] > 0 ? up[c] / down[c] : factor[c];
        }
    }
    return factor;
}

} // namespace

std::vector<glm::vec3> albedoFactors(const Observations& block, const NormalBlock& normals,
                                     const std::vector<Light>& lights)
{
    std::vector<glm::vec3> factors(block.pixels.size());
    for (size_t p = 0; p < factors.size(); ++p) {
        const PixelNormal& pixel = normals.pixels[p];
        if (pixel.confidence > 0) {
            const glm::vec3 colour = colourOf(block.radianceOf(p), &normals.verdicts[p * lights.size()], lights);
            factors[p] = pixel.albedo * glm::max(colour, glm::vec3(0));
        }
    }
    return factors;
}

void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights, const BrdfTable& table,
                 int threads, Image& albedo)
{
    const TableUnderLights under = tableUnder(lights, table);
    parallelFor(block.pixels.size(), 64, threads, [&](size_t first, size_t last) {
        PixelPrediction pixel;
        std::vector<Light> own;
        for (size_t p = first; p < last; ++p) {
            const uint32_t at = block.pixels[p];
            const int x = static_cast<int>(at % albedo.width), y = static_cast<int>(at / albedo.width);
            const glm::vec3 factor = albedo.rgb(x, y);
            const bool known = normals.confidence[at] > 0 && factor != glm::vec3(0);
            if (known &&
                predictPixel(block, p, lights.toLocal(at, normals.normals[at]), lights.of(at, own), under, pixel)) {
                albedo.setRgb(x, y, refittedFactor(pixel, factor));
            }
        }
    });
}

namespace {

// The median or the mean; 0 of none.
double middleOf(std::vector<float>& values, bool byMedian)
{
    if (values.empty()) {
        return 0;
    }
    return byMedian ? double{quantile(values, 0.5)}
                    : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

glm::vec3 normaliseAlbedo(bool haveOneAlbedo, Image& albedo, BrdfTable& table)
{
    std::array<std::vector<float>, 3> factors;
    for (size_t i = 0; i < albedo.values.size(); i += 3) {
        const glm::vec3 factor(albedo.values[i], albedo.values[i + 1], albedo.values[i + 2]);
        for (int c = 0; c < 3 && factor != glm::vec3(0); ++c) {
            factors[c].push_back(factor[c]);
        }
    }
    glm::vec3 taken(1);
    for (int c = 0; c < 3; ++c) {
        const double middle = middleOf(factors[c], haveOneAlbedo), divisor = middle > 0 ? middle : 1;
        taken[c] = static_cast<float>(divisor);
        for (size_t i = c; i < albedo.values.size(); i += 3) {
            albedo.values[i] = static_cast<float>(albedo.values[i] / divisor);
        }
        for (glm::vec3& value : table.values) {
            value[c] = static_cast<float>(value[c] * divisor);
        }
    }
    return taken;
}

} // namespace nacre
