#include "acquisition/diffuse_sphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/scene/error.h"
#include "engine/scene/measures.h"

namespace nacre {

namespace {

constexpr size_t kFewestPixels = 20;
constexpr float kOutlierSigmas = 3.0f;

struct SpherePixel {
    glm::vec3 normal;
    glm::vec3 radiance;
    float nDotL;
};

float grey(const glm::vec3& v)
{
    return (v.x + v.y + v.z) / 3;
}

std::vector<SpherePixel> pixelsInside(const Image& image, const Circle& outline, const glm::vec3& light)
{
    std::vector<SpherePixel> pixels;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const glm::vec3 n = sphereNormal(outline, x + 0.5, y + 0.5);
            if (n.z > 0) {
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
    return p.nDotL >= rules.nDotLMin && p.nDotL <= rules.nDotLMax && awayFromHighlight && grey(p.radiance) >= darkLevel;
}

// Drops pixels whose ratio I / n.l is far from the others': stains, seams, a supporting stand.
void dropOutliers(std::vector<SpherePixel>& pixels)
{
    std::vector<float> ratios, deviations;
    for (const SpherePixel& p : pixels) {
        ratios.push_back(grey(p.radiance) / p.nDotL);
    }
    const float median = quantile(ratios, 0.5);
    for (const SpherePixel& p : pixels) {
        deviations.push_back(std::abs(grey(p.radiance) / p.nDotL - median));
    }
    const float sigma = 1.4826f * quantile(deviations, 0.5);
    std::erase_if(pixels, [&](const SpherePixel& p) {
        return std::abs(grey(p.radiance) / p.nDotL - median) > kOutlierSigmas * std::max(sigma, 1e-6f * median);
    });
}

// I = g.n + offset by least squares; g points to the light.
void fitShading(const std::vector<SpherePixel>& pixels, DiffuseSphereReading& reading)
{
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const SpherePixel& p : pixels) {
        const Eigen::Vector4d row(p.normal.x, p.normal.y, p.normal.z, 1);
        normal += row * row.transpose();
        right += row * grey(p.radiance);
    }
    const Eigen::Vector4d s = normal.ldlt().solve(right);
    reading.shadingDirection = glm::normalize(glm::vec3(s.x(), s.y(), s.z()));
    reading.offset = static_cast<float>(s.w());
}

} // namespace

DiffuseSphereReading readDiffuseSphere(const Image& photograph, const Circle& outline, const glm::vec3& lightDirection,
                                       const std::filesystem::path& source, const DiffuseSphereRules& rules)
{
    std::vector<SpherePixel> pixels = pixelsInside(photograph, outline, lightDirection);
    const size_t all = pixels.size();
    std::vector<float> greys;
    for (const SpherePixel& p : pixels) {
        greys.push_back(grey(p.radiance));
    }
    const float darkLevel = greys.empty() ? 0 : rules.darkShare * quantile(greys, 0.99);
    std::erase_if(pixels, [&](const SpherePixel& p) {
        return !(darkLevel > 0) || !obeysRules(p, lightDirection, darkLevel, rules);
    });
    if (pixels.size() >= kFewestPixels) {
        dropOutliers(pixels);
    }
    if (pixels.size() < kFewestPixels) {
        throw Error(source, fmt::format("has {} pixels that speak of the light", pixels.size()),
                    fmt::format("at least {} lit pixels of a diffuse sphere", kFewestPixels));
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
    fitShading(pixels, reading);
    return reading;
}

} // namespace nacre
