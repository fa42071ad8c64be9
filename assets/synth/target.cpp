#include "assets/synth/target.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

using glm::dvec2;
using glm::dvec3;

// Samples over the shorter side, about: small pictures are means of many, large ones still have 2x2 a pixel.
constexpr int kReliefSamples = 1536;
constexpr int kMostReliefPerSide = 8;
constexpr size_t kMostParts = 8;

// Samples along a pixel's side.
int samplesPerPixel(int width, int height)
{
    const int side = std::min(width, height);
    return std::clamp((kReliefSamples + side - 1) / side, 2, kMostReliefPerSide);
}

// The samples at the corners of a pixel grid `perPixel` times as fine, for pixel rows [first, last).
struct Band {
    int columns = 0;
    std::vector<double> heights; // in steps between samples
    std::vector<uint8_t> parts;

    Band(const Relief& relief, int width, int height, int perPixel, size_t first, size_t last)
        : columns(width * perPixel + 1)
    {
        const int rows = static_cast<int>(last - first) * perPixel + 1;
        const double step = reliefSpacing(width, height);
        const dvec2 topLeft(-0.5 * step * width * perPixel,
                            step * perPixel * (0.5 * height - static_cast<double>(first)));
        heights.reserve(static_cast<size_t>(rows) * columns);
        parts.reserve(heights.capacity());
        for (int y = 0; y < rows; ++y) {
            for (int x = 0; x < columns; ++x) {
                const ReliefPoint point = relief(topLeft + step * dvec2(x, -y));
                heights.push_back(point.height / step);
                parts.push_back(point.part);
            }
        }
    }
};

void fillPixel(Target& target, size_t pixel, const Band& band, int perPixel, size_t corner)
{
    dvec3 normal(0);
    double height = 0;
    std::array<int, kMostParts> counts{};
    for (int s = 0; s < perPixel * perPixel; ++s) {
        const size_t i = corner + static_cast<size_t>(s / perPixel) * band.columns + s % perPixel;
        const double a = band.heights[i], b = band.heights[i + 1];
        const double c = band.heights[i + band.columns], d = band.heights[i + band.columns + 1];
        normal += glm::normalize(dvec3(0.5 * (a - b + c - d), 0.5 * (c - a + d - b), 1.0)); // rows run downwards
        height += 0.25 * (a + b + c + d);
        ++counts[band.parts[i]];
    }
    target.normals.normals[pixel] = glm::vec3(glm::normalize(normal));
    target.normals.confidence[pixel] = 1.0f;
    target.height.values[pixel] = static_cast<float>(height / (perPixel * perPixel) / perPixel);
    target.labels[pixel] = static_cast<uint8_t>(std::max_element(counts.begin(), counts.end()) - counts.begin());
}

} // namespace

double reliefSpacing(int width, int height)
{
    return 2.0 / (static_cast<double>(std::min(width, height)) * samplesPerPixel(width, height));
}

double detailShare(double period, double spacing)
{
    return std::clamp(0.5 * period / spacing - 1.0, 0.0, 1.0);
}

Target targetFromRelief(int width, int height, std::vector<std::string> parts, const Relief& relief, int threads)
{
    constexpr size_t kRowsAtOnce = 8;
    Target target(width, height, std::move(parts));
    const int perPixel = samplesPerPixel(width, height);
    parallelFor(height, kRowsAtOnce, threads, [&](size_t first, size_t last) {
        const Band band(relief, width, height, perPixel, first, last);
        for (size_t pixel = first * width; pixel < last * width; ++pixel) {
            const size_t row = pixel / width - first, column = pixel % width;
            fillPixel(target, pixel, band, perPixel, (row * band.columns + column) * perPixel);
        }
    });
    return target;
}

} // namespace nacre
