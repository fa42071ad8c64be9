#include "acquisition/brdf/albedo_factor.h"

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

void normaliseAlbedo(Image& albedo, BrdfTable& table)
{
    glm::dvec3 sum(0);
    size_t pixels = 0;
    for (size_t i = 0; i < albedo.values.size(); i += 3) {
        const glm::vec3 factor(albedo.values[i], albedo.values[i + 1], albedo.values[i + 2]);
        if (factor != glm::vec3(0)) {
            sum += glm::dvec3(factor);
            ++pixels;
        }
    }
    for (int c = 0; c < 3; ++c) {
        const double mean = pixels && sum[c] > 0 ? sum[c] / static_cast<double>(pixels) : 1;
        for (size_t i = c; i < albedo.values.size(); i += 3) {
            albedo.values[i] = static_cast<float>(albedo.values[i] / mean);
        }
        for (glm::vec3& value : table.values) {
            value[c] = static_cast<float>(value[c] * mean);
        }
    }
}

} // namespace nacre
