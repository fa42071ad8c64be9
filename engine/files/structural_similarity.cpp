#include "engine/files/structural_similarity.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kReach = 5; // pixels on either side of a window's middle
constexpr double kSigma = 1.5;
// (K1 L)^2 and (K2 L)^2, L = 1 being the range of the values.
constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
constexpr size_t kRowsPerChunk = 8; // each chunk filters its rows by itself

using Weights = std::array<double, 2 * kReach + 1>;

// Weighted sums of a window, of one channel: of the values, their squares and their product.
struct Moments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

    void add(double weight, const Moments& m)
    {
        a += weight * m.a, b += weight * m.b;
        aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
    }
};
using PixelMoments = std::array<Moments, 3>; // red, green, blue

// Of the window [i - kReach, i + kReach] cut off at [0, count), adding up to 1.
Weights windowWeights(int i, int count)
{
    Weights weights{};
    double sum = 0;
    for (int d = -kReach; d <= kReach; ++d) {
        if (i + d >= 0 && i + d < count) {
            weights[d + kReach] = std::exp(-0.5 * d * d / (kSigma * kSigma));
            sum += weights[d + kReach];
        }
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

// Eq. 13. Rounding may leave a variance of -1e-17, which the constants outweigh.
double similarity(const Moments& m)
{
    const double varianceA = m.aa - m.a * m.a, varianceB = m.bb - m.b * m.b, covariance = m.ab - m.a * m.b;
    return (2 * m.a * m.b + kC1) * (2 * covariance + kC2) /
           ((m.a * m.a + m.b * m.b + kC1) * (varianceA + varianceB + kC2));
}

// The first half of the separable window: every column of row y.
std::vector<PixelMoments> momentsOfColumns(const Image& a, const Image& b, int y)
{
    const Weights weights = windowWeights(y, a.height);
    std::vector<PixelMoments> columns(a.width);
    for (int row = std::max(0, y - kReach); row <= std::min(a.height - 1, y + kReach); ++row) {
        for (int x = 0; x < a.width; ++x) {
            const glm::vec3 left = a.rgb(x, row), right = b.rgb(x, row);
            for (int c = 0; c < 3; ++c) {
                const double p = left[c], q = right[c];
                columns[x][c].add(weights[row - y + kReach], {p, q, p * p, q * q, p * q});
            }
        }
    }
    return columns;
}

// The second half, and the mean of the three channels.
double pixelSimilarity(const std::vector<PixelMoments>& columns, int x, const Weights& weights)
{
    const int width = static_cast<int>(columns.size());
    PixelMoments window{};
    for (int column = std::max(0, x - kReach); column <= std::min(width - 1, x + kReach); ++column) {
        for (int c = 0; c < 3; ++c) {
            window[c].add(weights[column - x + kReach], columns[column][c]);
        }
    }
    return (similarity(window[0]) + similarity(window[1]) + similarity(window[2])) / 3;
}

} // namespace

double structuralSimilarity(const Image& a, const Image& b, std::span<const uint8_t> mask)
{
    assert(a.width == b.width && a.height == b.height && mask.size() == a.pixelCount());
    std::vector<Weights> weights;
    for (int x = 0; x < a.width; ++x) {
        weights.push_back(windowWeights(x, a.width));
    }
    // Summed row by row, so that the order does not depend on the number of threads.
    std::vector<double> rowSums(a.height, 0.0);
    parallelFor(rowSums.size(), kRowsPerChunk, 0, [&](size_t first, size_t last) {
        for (size_t y = first; y < last; ++y) {
            const auto row = mask.subspan(y * a.width, a.width);
            if (std::none_of(row.begin(), row.end(), [](uint8_t m) { return m != 0; })) {
                continue;
            }
            const std::vector<PixelMoments> columns = momentsOfColumns(a, b, static_cast<int>(y));
            for (int x = 0; x < a.width; ++x) {
                rowSums[y] += row[x] ? pixelSimilarity(columns, x, weights[x]) : 0;
            }
        }
    });
    double sum = 0;
    for (const double rowSum : rowSums) {
        sum += rowSum;
    }
    const auto count = std::count_if(mask.begin(), mask.end(), [](uint8_t m) { return m != 0; });
    return count == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(count);
}

double structuralSimilarity(const Image& a, const Image& b)
{
    return structuralSimilarity(a, b, std::vector<uint8_t>(a.pixelCount(), 1));
}

} // namespace nacre
