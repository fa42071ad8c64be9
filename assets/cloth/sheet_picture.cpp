#include "assets/cloth/draped_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kPatchPieces = 4; // of a patch between four particles, along a side
constexpr int kSamples = 1536;  // over the picture's shorter side, about
constexpr int kMostPerSide = 8; // samples along a pixel's side

struct Vertex {
    dvec3 place;
    dvec3 normal; // not unit
};

// Weights of a uniform cubic B-spline and of its derivative at s in [0,1] of its middle piece.
void splineWeights(double s, std::array<double, 4>& weights, std::array<double, 4>& slopes)
{
    const double r = 1 - s;
    weights = {r * r * r / 6, (3 * s * s * s - 6 * s * s + 4) / 6, (3 * r * r * r - 6 * r * r + 4) / 6, s * s * s / 6};
    slopes = {-r * r / 2, (3 * s * s - 4 * s) / 2, (4 * r - 3 * r * r) / 2, s * s / 2};
}

class SmoothSheet {
public:
    SmoothSheet(const ClothSheet& sheet, int threads)
        : side_((sheet.side - 1) * kPatchPieces + 1), vertices_(static_cast<size_t>(side_) * side_)
    {
        parallelFor(side_, 16, threads, [&](size_t first, size_t last) {
            for (size_t i = first * side_; i < last * side_; ++i) {
                vertices_[i] = vertexOf(sheet, static_cast<int>(i % side_), static_cast<int>(i / side_));
            }
        });
    }

    int side() const { return side_; }
    const Vertex& at(int column, int row) const { return vertices_[static_cast<size_t>(row) * side_ + column]; }

private:
    // Beyond a hem the sheet goes on straight: the mirror point of the particle inside.
    static dvec3 particle(const ClothSheet& sheet, int column, int row)
    {
        const int last = sheet.side - 1;
        if (column < 0 || column > last) {
            const int hem = column < 0 ? 0 : last;
            return 2.0 * particle(sheet, hem, row) - particle(sheet, 2 * hem - column, row);
        }
        if (row < 0 || row > last) {
            const int hem = row < 0 ? 0 : last;
            return 2.0 * particle(sheet, column, hem) - particle(sheet, column, 2 * hem - row);
        }
        return sheet.places[sheet.index(column, row)];
    }

    static Vertex vertexOf(const ClothSheet& sheet, int column, int row)
    {
        const int x = std::min(column / kPatchPieces, sheet.side - 2), y = std::min(row / kPatchPieces, sheet.side - 2);
        std::array<double, 4> wx, wy, sx, sy;
        splineWeights(static_cast<double>(column) / kPatchPieces - x, wx, sx);
        splineWeights(static_cast<double>(row) / kPatchPieces - y, wy, sy);
        dvec3 place(0), alongU(0), alongV(0);
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 4; ++i) {
                const dvec3 p = particle(sheet, x + i - 1, y + j - 1);
                place += wx[i] * wy[j] * p;
                alongU += sx[i] * wy[j] * p;
                alongV += wx[i] * sy[j] * p;
            }
        }
        return {place, glm::cross(alongU, alongV)};
    }

    int side_;
    std::vector<Vertex> vertices_;
};

struct Sample {
    double z = -std::numeric_limits<double>::infinity();
    glm::vec3 normal{0};
    uint8_t part = 0;
};

// The samples of some rows of the picture, nearest surface first.
struct SampleBand {
    int columns, firstRow, lastRow;
    std::vector<Sample> samples;

    SampleBand(int c, int first, int last)
        : columns(c), firstRow(first), lastRow(last), samples(static_cast<size_t>(last - first) * c)
    {
    }

    // Corners in samples: x right, y down.
    void draw(const std::array<Vertex, 3>& v)
    {
        const dvec2 a(v[0].place), ab = dvec2(v[1].place) - a, ac = dvec2(v[2].place) - a;
        const double area = ab.x * ac.y - ab.y * ac.x;
        const auto [lowX, highX] = std::minmax({v[0].place.x, v[1].place.x, v[2].place.x});
        const auto [lowY, highY] = std::minmax({v[0].place.y, v[1].place.y, v[2].place.y});
        const int left = std::max(0, static_cast<int>(std::ceil(lowX - 0.5)));
        const int right = std::min(columns - 1, static_cast<int>(std::floor(highX - 0.5)));
        const int top = std::max(firstRow, static_cast<int>(std::ceil(lowY - 0.5)));
        const int bottom = std::min(lastRow - 1, static_cast<int>(std::floor(highY - 0.5)));
        for (int y = top; area != 0 && y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const dvec2 p = dvec2(x + 0.5, y + 0.5) - a;
                const double b = (p.x * ac.y - p.y * ac.x) / area, c = (ab.x * p.y - ab.y * p.x) / area;
                if (b >= 0 && c >= 0 && b + c <= 1) {
                    put(x, y, v, {1 - b - c, b, c});
                }
            }
        }
    }

private:
    void put(int x, int y, const std::array<Vertex, 3>& v, const dvec3& weights)
    {
        Sample& sample = samples[static_cast<size_t>(y - firstRow) * columns + x];
        const double z = weights.x * v[0].place.z + weights.y * v[1].place.z + weights.z * v[2].place.z;
        if (z <= sample.z) {
            return;
        }
        // On the contour interpolated normals may look away a little; 0.02 keeps them in sight.
        constexpr double kLeastZ = 0.02;
        dvec3 n = glm::normalize(weights.x * v[0].normal + weights.y * v[1].normal + weights.z * v[2].normal);
        const bool face = n.z >= 0;
        n = face ? n : -n;
        sample = {z, glm::vec3(glm::normalize(dvec3(n.x, n.y, std::max(n.z, kLeastZ)))), static_cast<uint8_t>(!face)};
    }
};

// A vertex in samples of the picture; z stays in samples towards the viewer.
Vertex inSamples(Vertex vertex, const dvec2& middle, double halfSide)
{
    vertex.place = {middle.x + halfSide * vertex.place.x, middle.y - halfSide * vertex.place.y,
                    halfSide * vertex.place.z};
    return vertex;
}

void drawSheet(const SmoothSheet& sheet, const dvec2& middle, double halfSide, SampleBand& band)
{
    for (int row = 0; row + 1 < sheet.side(); ++row) {
        for (int column = 0; column + 1 < sheet.side(); ++column) {
            const std::array<Vertex, 4> v = {inSamples(sheet.at(column, row), middle, halfSide),
                                             inSamples(sheet.at(column + 1, row), middle, halfSide),
                                             inSamples(sheet.at(column, row + 1), middle, halfSide),
                                             inSamples(sheet.at(column + 1, row + 1), middle, halfSide)};
            const auto [low, high] = std::minmax({v[0].place.y, v[1].place.y, v[2].place.y, v[3].place.y});
            if (high >= band.firstRow && low <= band.lastRow) {
                band.draw({v[0], v[1], v[2]});
                band.draw({v[1], v[3], v[2]});
            }
        }
    }
}

// A pixel shows the sheet where half of its samples do, and is the mean of those.
void fillPixel(Target& target, size_t pixel, const SampleBand& band, int perPixel, size_t corner)
{
    glm::dvec3 normal(0);
    double height = 0;
    int seen = 0, reverse = 0;
    for (int s = 0; s < perPixel * perPixel; ++s) {
        const Sample& sample = band.samples[corner + static_cast<size_t>(s / perPixel) * band.columns + s % perPixel];
        if (std::isfinite(sample.z)) {
            normal += glm::dvec3(sample.normal);
            height += sample.z;
            reverse += sample.part;
            ++seen;
        }
    }
    if (2 * seen < perPixel * perPixel) {
        return;
    }
    target.normals.normals[pixel] = glm::vec3(glm::normalize(normal));
    target.normals.confidence[pixel] = 1;
    target.height.values[pixel] = static_cast<float>(height / seen / perPixel);
    target.labels[pixel] = 2 * reverse > seen;
}

} // namespace

Target sheetPicture(const ClothSheet& sheet, int width, int height, std::vector<std::string> parts, int threads)
{
    const int side = std::min(width, height);
    const int perPixel = std::clamp((kSamples + side - 1) / side, 2, kMostPerSide);
    const SmoothSheet smooth(sheet, threads);
    Target target(width, height, std::move(parts));
    const size_t rowsAtOnce = std::max(1, height / 8); // each band walks all of the sheet
    parallelFor(height, rowsAtOnce, threads, [&](size_t first, size_t last) {
        SampleBand band(width * perPixel, static_cast<int>(first) * perPixel, static_cast<int>(last) * perPixel);
        drawSheet(smooth, 0.5 * perPixel * dvec2(width, height), 0.5 * perPixel * side, band);
        for (size_t pixel = first * width; pixel < last * width; ++pixel) {
            const size_t row = pixel / width - first, column = pixel % width;
            fillPixel(target, pixel, band, perPixel, (row * band.columns + column) * perPixel);
        }
    });
    return target;
}

} // namespace nacre
