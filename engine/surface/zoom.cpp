#include "engine/surface/zoom.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "shared/zoom.h"

namespace nacre {
namespace {

// Normals further apart are of two surfaces, one before the other, or of an edge: what lies between is neither's.
constexpr float kSameSurface = 0.5f; // cosine
constexpr int kNeighbours = 9;       // the pixel of a place and those around it

using Shares = std::array<float, kNeighbours>;

// The pixels around a place, and the weights of those of one surface, which add up to 1 where there are any.
struct Neighbours {
    std::array<size_t, kNeighbours> pixels;
    Shares weights;
    uint8_t label = Surface::kNoMaterial;
    float cover = 0; // share of the place that has a normal
};

float linearWeight(float away)
{
    return std::max(0.0f, 1 - std::abs(away));
}

// Quadratic B-spline: of an outline's stairs it makes a line, and leaves lines of one pixel there.
float splineWeight(float away)
{
    const float a = std::abs(away);
    return a < 0.5f ? 0.75f - a * a : 0.5f * (1.5f - a) * (1.5f - a);
}

// Leaves weights of the one surface that has most of the place by `shares`: of one material, and with normals like
// those of one of its pixels. They then add up to 1.
void keepOneSurface(const Surface& surface, const Shares& shares, Neighbours& found)
{
    const auto isLike = [&](int k, int middle) {
        const size_t p = found.pixels[k], q = found.pixels[middle];
        return surface.labels[p] == surface.labels[q] &&
               glm::dot(surface.normals.normals[p], surface.normals.normals[q]) >= kSameSurface;
    };
    int best = 0;
    float most = 0;
    for (int middle = 0; middle < kNeighbours && most < found.cover; ++middle) {
        float share = 0;
        for (int k = 0; shares[middle] > 0 && k < kNeighbours; ++k) {
            share += shares[k] > 0 && isLike(k, middle) ? shares[k] : 0.0f;
        }
        best = share > most ? middle : best;
        most = std::max(most, share);
    }
    found.label = surface.labels[found.pixels[best]];
    float sum = 0, sumOfShares = 0;
    Shares kept;
    for (int k = 0; k < kNeighbours; ++k) {
        const bool isKept = shares[k] > 0 && isLike(k, best);
        kept[k] = isKept ? shares[k] : 0.0f;
        found.weights[k] = isKept ? found.weights[k] : 0.0f;
        sum += found.weights[k];
        sumOfShares += kept[k];
    }
    for (int k = 0; k < kNeighbours; ++k) { // none is within a pixel: just outside
        found.weights[k] = sum > 0 ? found.weights[k] / sum : kept[k] / sumOfShares;
    }
}

Neighbours neighboursOf(const Surface& surface, const glm::vec2& place)
{
    const int width = surface.normals.width, height = surface.normals.height;
    const glm::ivec2 middle(glm::floor(place));
    Neighbours found;
    Shares shares;
    for (int k = 0; k < kNeighbours; ++k) {
        const glm::ivec2 pixel = middle + glm::ivec2(k % 3 - 1, k / 3 - 1);
        const glm::vec2 away = place - (glm::vec2(pixel) + 0.5f);
        const size_t p = surface.normals.index(std::clamp(pixel.x, 0, width - 1), std::clamp(pixel.y, 0, height - 1));
        const bool isValid = surface.normals.confidence[p] > 0 && surface.labels[p] != Surface::kNoMaterial;
        found.pixels[k] = p;
        found.weights[k] = isValid ? linearWeight(away.x) * linearWeight(away.y) : 0.0f;
        shares[k] = isValid ? splineWeight(away.x) * splineWeight(away.y) : 0.0f;
        found.cover += shares[k];
    }
    if (found.cover > 0) {
        keepOneSurface(surface, shares, found);
    }
    return found;
}

template <class Value, class At> Value mixed(const Neighbours& at, Value sum, const At& valueOf)
{
    for (int k = 0; k < kNeighbours; ++k) {
        if (at.weights[k] > 0) {
            sum += at.weights[k] * valueOf(at.pixels[k]);
        }
    }
    return sum;
}

uint8_t codeOf(float mean)
{
    return static_cast<uint8_t>(mean + 0.5f);
}

// Everything but the horizon and the residual layer.
void fillPixel(const Surface& from, const Neighbours& at, Surface& to, size_t i)
{
    to.labels[i] = at.label;
    to.normals.normals[i] = glm::normalize(mixed(at, glm::vec3(0), [&](size_t p) { return from.normals.normals[p]; }));
    to.normals.confidence[i] = mixed(at, 0.0f, [&](size_t p) { return from.normals.confidence[p]; });
    if (!from.places.empty()) {
        to.places[i] = mixed(at, glm::vec3(0), [&](size_t p) { return from.places[p]; });
    }
    if (!from.albedo.values.empty()) {
        const glm::vec3 factor = mixed(at, glm::vec3(0), [&](size_t p) { return albedoFactor(from, p); });
        std::copy_n(&factor.x, 3, &to.albedo.values[3 * i]);
    }
}

void fillCodes(const Surface& from, const Neighbours& at, Surface& to, size_t i)
{
    for (int azimuth = 0; azimuth < from.horizon.azimuths; ++azimuth) {
        to.horizon.at(azimuth, i) =
            codeOf(mixed(at, 0.0f, [&](size_t p) { return static_cast<float>(from.horizon.at(azimuth, p)); }));
    }
    for (size_t layer = 0; !from.residual.empty() && layer < from.residual.layers(); ++layer) {
        for (size_t c = 0; c < kComponentsPerTexel; ++c) {
            const auto code = [&](size_t p) {
                return static_cast<float>(
                    from.residual.codes[(layer * from.residual.pixelCount() + p) * kComponentsPerTexel + c]);
            };
            to.residual.codes[(layer * to.residual.pixelCount() + i) * kComponentsPerTexel + c] =
                codeOf(mixed(at, 0.0f, code));
        }
    }
}

// Without values yet.
Surface pixelsLike(const Surface& surface, const glm::ivec2& size)
{
    Surface pixels;
    pixels.camera = surface.camera;
    pixels.normals = NormalMap(size.x, size.y);
    pixels.labels.assign(pixels.normals.normals.size(), Surface::kNoMaterial);
    pixels.albedo = surface.albedo.values.empty() ? Image() : Image(size.x, size.y, 3, 1.0f);
    pixels.places.resize(surface.places.empty() ? 0 : pixels.labels.size());
    const std::vector<int64_t> none(pixels.labels.size(), -1);
    pixels.horizon = pickedHorizon(surface.horizon, none, size.x, size.y);
    pixels.residual = pickedResidual(surface.residual, none, size.x, size.y);
    return pixels;
}

glm::vec2 placeOf(const Zoom& zoom, size_t i)
{
    const glm::vec2 pixel(i % static_cast<size_t>(zoom.size.x), i / static_cast<size_t>(zoom.size.x));
    return zoom.origin + (pixel + 0.5f) / zoom.scale;
}

float rounded(float code)
{
    return std::round(255 * code) / 255;
}

// The pixels of a row or column of which one of it reduced is the mean, and their shares.
std::vector<std::pair<int, float>> sharesOf(float origin, float scale, int pixel, int count)
{
    const float low = borderOfReduced(origin, scale, pixel, count);
    const float high = borderOfReduced(origin, scale, pixel + 1, count);
    std::vector<std::pair<int, float>> shares;
    for (int k = 0; k < reachOfReduced(scale); ++k) {
        const glm::vec2 at = pixelOfReduced(low, high, k, reachOfReduced(scale));
        shares.emplace_back(std::min(static_cast<int>(at.x), count - 1), at.y);
    }
    return shares;
}

// The mean of what `value` makes of the picture's pixels.
template <class Value> Image reduced(const Image& picture, const Zoom& zoom, const Value& value)
{
    Image mean(zoom.size.x, zoom.size.y, 3);
    for (int y = 0; y < mean.height; ++y) {
        const auto rows = sharesOf(zoom.origin.y, zoom.scale, y, picture.height);
        for (int x = 0; x < mean.width; ++x) {
            glm::vec3 sum(0);
            for (const auto& [column, across] : sharesOf(zoom.origin.x, zoom.scale, x, picture.width)) {
                for (const auto& [row, down] : rows) {
                    sum += across * down * value(picture.rgb(column, row));
                }
            }
            mean.setRgb(x, y, sum);
        }
    }
    return mean;
}

} // namespace

Zoom wholeZoom(int width, int height, float scale)
{
    const auto scaled = [&](int length) {
        return std::max(1, static_cast<int>(std::lround(scale * static_cast<float>(length))));
    };
    return {.scale = scale, .origin = {0, 0}, .size = {scaled(width), scaled(height)}};
}

MagnifiedSurface magnified(const Surface& surface, const Zoom& zoom, int threads)
{
    MagnifiedSurface all{.pixels = pixelsLike(surface, zoom.size), .cover = {}};
    all.cover.resize(all.pixels.labels.size());
    parallelFor(all.cover.size(), 4096, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const Neighbours at = neighboursOf(surface, placeOf(zoom, i));
            all.cover[i] = codeOf(255 * coverOfPixel(at.cover, zoom.scale));
            if (all.cover[i] > 0) {
                fillPixel(surface, at, all.pixels, i);
                fillCodes(surface, at, all.pixels, i);
            }
        }
    });
    return all;
}

Image coveredCodes(const Image& codes, const std::vector<uint8_t>& cover)
{
    Image covered = codes;
    for (size_t i = 0; i < covered.values.size(); ++i) {
        const glm::vec3 light = lightOfCode(glm::vec3(covered.values[i]));
        covered.values[i] = rounded(codeOfLight(static_cast<float>(cover[i / 3]) / 255 * light).x);
    }
    return covered;
}

Image coveredRadiance(const Image& radiance, const std::vector<uint8_t>& cover)
{
    Image covered = radiance;
    for (size_t i = 0; i < covered.values.size(); ++i) {
        covered.values[i] *= static_cast<float>(cover[i / 3]) / 255;
    }
    return covered;
}

Image reducedCodes(const Image& codes, const Zoom& zoom)
{
    Image mean = reduced(codes, zoom, lightOfCode);
    for (float& light : mean.values) {
        light = rounded(codeOfLight(glm::vec3(light)).x);
    }
    return mean;
}

Image reducedRadiance(const Image& radiance, const Zoom& zoom)
{
    return reduced(radiance, zoom, [](const glm::vec3& value) { return value; });
}

} // namespace nacre
