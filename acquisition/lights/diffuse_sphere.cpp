#include "acquisition/lights/diffuse_sphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/capture/exposure_merge.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr size_t kFewestSpherePixels = 20;
constexpr float kSphereOutlierSigmas = 3.0f;
constexpr int kTrimPasses = 3;
// Attached shadow begins this far behind the terminator, so that neither a wrong direction nor the light's size
// matters.
constexpr float kShadowNDotL = -0.15f;
// Pixels closer to the outline may show the background.
constexpr float kLeastFacing = 0.2f;

struct SpherePixel {
    glm::vec3 normal;
    glm::vec3 radiance;
    float nDotL;
};

std::vector<SpherePixel> pixelsInside(const Image& image, const Circle& outline, const glm::vec3& light,
                                      std::span<const uint8_t> saturated)
{
    std::vector<SpherePixel> pixels;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 n = sphereNormal(outline, x + 0.5, y + 0.5);
            const bool trusted = saturated.empty() || !saturated[static_cast<size_t>(y) * image.width + x];
            if (n.z > 0 && trusted) {
                pixels.push_back({n, image.rgb(x, y), glm::dot(n, light)});
            }
        }
    }
    return pixels;
}

bool obeysRules(const SpherePixel& p, const glm::vec3& light, float darkLevel, const DiffuseSphereRules& rules)
{
    const glm::vec3 mirrored = 2 * p.nDotL * p.normal - light;
    const bool awayFromHighlight = mirrored.z < std::cos(glm::radians(rules.highlightDegrees));
    return p.nDotL >= rules.nDotLMin && p.nDotL <= rules.nDotLMax && awayFromHighlight &&
           channelMean(p.radiance) >= darkLevel;
}

// Drops pixels whose ratio I / n.l is far from the others': stains, seams, a supporting stand.
void dropOutliers(std::vector<SpherePixel>& pixels)
{
    std::vector<float> ratios, deviations;
    for (const SpherePixel& p : pixels) {
        ratios.push_back(channelMean(p.radiance) / p.nDotL);
    }
    const float median = quantile(ratios, 0.5);
    for (const SpherePixel& p : pixels) {
        deviations.push_back(std::abs(channelMean(p.radiance) / p.nDotL - median));
    }
    const float sigma = 1.4826f * quantile(deviations, 0.5);
    std::erase_if(pixels, [&](const SpherePixel& p) {
        return std::abs(channelMean(p.radiance) / p.nDotL - median) >
               kSphereOutlierSigmas * std::max(sigma, 1e-6f * median);
    });
}

// Pixels of which shading may be asked without much faith in the light's direction: lit, beyond the highlight, and
// with a margin from the terminator, where a wrong direction would mistake attached shadow for shading.
std::vector<SpherePixel> shadedPixels(const std::vector<SpherePixel>& all, const glm::vec3& light,
                                      const DiffuseSphereRules& rules)
{
    DiffuseSphereRules wider = rules;
    wider.nDotLMax = 1;
    std::vector<SpherePixel> pixels;
    std::copy_if(all.begin(), all.end(), std::back_inserter(pixels),
                 [&](const SpherePixel& p) { return obeysRules(p, light, 0, wider); });
    return pixels;
}

ShadingSums sumsOf(const std::vector<SpherePixel>& pixels)
{
    ShadingSums sums;
    for (const SpherePixel& p : pixels) {
        const glm::dvec3 n(p.normal);
        const double value = channelMean(p.radiance);
        sums.normalProducts += glm::outerProduct(n, n);
        sums.normals += n;
        sums.radianceNormals += value * n;
        sums.radiance += value;
        sums.count += 1;
    }
    return sums;
}

// The offset that fits all photographs best, each with its own g: their normal equations with g eliminated.
double commonOffset(std::span<const ShadingSums> photographs)
{
    double left = 0, right = 0;
    for (const ShadingSums& s : photographs) {
        const glm::dvec3 eliminated = glm::inverse(s.normalProducts) * s.normals;
        left += s.count - glm::dot(eliminated, s.normals);
        right += s.radiance - glm::dot(eliminated, s.radianceNormals);
    }
    return left > 0 ? right / left : 0;
}

// g of I = g.n + offset by least squares; it points to the light.
glm::dvec3 shadingOf(const ShadingSums& sums, double offset)
{
    return glm::inverse(sums.normalProducts) * (sums.radianceNormals - offset * sums.normals);
}

void readShadow(const std::vector<SpherePixel>& all, DiffuseSphereReading& reading)
{
    std::vector<float> values;
    for (const SpherePixel& p : all) {
        if (p.nDotL < kShadowNDotL && p.normal.z > kLeastFacing) {
            values.push_back(channelMean(p.radiance));
        }
    }
    reading.shadowPixels = values.size();
    reading.shadowLevel = values.empty() ? 0 : quantile(values, 0.5);
}

double offsetOf(std::span<const DiffuseSphereReading> readings)
{
    double pixels = 0, sum = 0;
    std::vector<ShadingSums> sums;
    for (const DiffuseSphereReading& reading : readings) {
        pixels += static_cast<double>(reading.shadowPixels);
        sum += static_cast<double>(reading.shadowPixels) * reading.shadowLevel;
        sums.push_back(reading.sums);
    }
    return pixels >= kFewestSpherePixels ? sum / pixels : commonOffset(sums);
}

// Drops what the fit does not explain, and fits again.
void fitShading(std::vector<SpherePixel> pixels, DiffuseSphereReading& reading)
{
    for (int pass = 0;; ++pass) {
        reading.sums = sumsOf(pixels);
        const double offset = offsetOf({&reading, 1});
        const glm::dvec3 g = shadingOf(reading.sums, offset);
        reading.shadingDirection = glm::vec3(glm::normalize(g));
        reading.offset = static_cast<float>(offset);
        if (pass == kTrimPasses) {
            return;
        }
        const auto residual = [&](const SpherePixel& p) {
            return std::abs(channelMean(p.radiance) - static_cast<float>(glm::dot(g, glm::dvec3(p.normal)) + offset));
        };
        std::vector<float> residuals;
        std::transform(pixels.begin(), pixels.end(), std::back_inserter(residuals), residual);
        const float bound = std::max(kSphereOutlierSigmas * 1.4826f * quantile(residuals, 0.5),
                                     1e-6f * static_cast<float>(glm::length(g)));
        std::erase_if(pixels, [&](const SpherePixel& p) { return residual(p) > bound; });
    }
}

} // namespace

DiffuseSphereReading readDiffuseSphere(const Image& photograph, const Circle& outline, const glm::vec3& lightDirection,
                                       const std::filesystem::path& source, const DiffuseSphereRules& rules,
                                       std::span<const uint8_t> saturated)
{
    const std::vector<SpherePixel> everything = pixelsInside(photograph, outline, lightDirection, saturated);
    std::vector<SpherePixel> pixels = everything;
    std::vector<SpherePixel> shaded = shadedPixels(everything, lightDirection, rules);
    const size_t all = pixels.size();
    std::vector<float> greys;
    for (const SpherePixel& p : pixels) {
        greys.push_back(channelMean(p.radiance));
    }
    const float darkLevel = greys.empty() ? 0 : rules.darkShare * quantile(greys, 0.99);
    std::erase_if(pixels, [&](const SpherePixel& p) {
        return !(darkLevel > 0) || !obeysRules(p, lightDirection, darkLevel, rules);
    });
    if (pixels.size() >= kFewestSpherePixels) {
        dropOutliers(pixels);
    }
    if (pixels.size() < kFewestSpherePixels) {
        throw Error(source, fmt::format("has {} pixels that speak of the light", pixels.size()),
                    fmt::format("at least {} lit pixels of a diffuse sphere", kFewestSpherePixels));
    }
    DiffuseSphereReading reading;
    glm::dvec3 sum(0);
    double cosines = 0;
    for (const SpherePixel& p : pixels) {
        sum += glm::dvec3(p.radiance);
        cosines += p.nDotL;
    }
    reading.radiance = glm::vec3(sum / cosines);
    reading.pixels = pixels.size();
    reading.rejected = all - pixels.size();
    readShadow(everything, reading);
    fitShading(std::move(shaded), reading);
    return reading;
}

void shareOffset(std::span<DiffuseSphereReading> readings)
{
    const double offset = offsetOf(readings);
    for (DiffuseSphereReading& reading : readings) {
        reading.offset = static_cast<float>(offset);
        reading.shadingDirection = glm::vec3(glm::normalize(shadingOf(reading.sums, offset)));
    }
}

} // namespace nacre
