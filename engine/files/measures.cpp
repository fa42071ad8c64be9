#include "engine/files/measures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/files/lanes.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

double psnrFromSquaredError(double sum, size_t count)
{
    if (count == 0) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    return sum == 0 ? std::numeric_limits<double>::infinity() : -10 * std::log10(sum / static_cast<double>(count));
}

// Over mask pixels and colour channels, of values scaled and clipped to [0,1].
double psnrOfClipped(const Image& a, const Image& b, std::span<const uint8_t> mask, double scale)
{
    assert(a.width == b.width && a.height == b.height && mask.size() == a.pixelCount());
    double sum = 0;
    size_t count = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            if (!mask[static_cast<size_t>(y) * a.width + x]) {
                continue;
            }
            const glm::vec3 left = a.rgb(x, y), right = b.rgb(x, y);
            for (int c = 0; c < 3; ++c) {
                const double d = std::clamp(left[c] * scale, 0.0, 1.0) - std::clamp(right[c] * scale, 0.0, 1.0);
                sum += d * d;
            }
            count += 3;
        }
    }
    return psnrFromSquaredError(sum, count);
}

constexpr size_t kFewValues = 512;

// Whole numbers in the order of the floats whose bits they are, and back: negative ones fall as their bits rise.
int32_t orderedBits(int32_t bits)
{
    return bits >= 0 ? bits : bits ^ std::numeric_limits<int32_t>::max();
}

// Two neighbouring order statistics of at most kFewValues; the last one's neighbour is itself. Bisection on the bits of
// a float: the statistic of rank k, from 0, is the largest f that no more than k values are less than, and the least of
// the values that are no less than an f that k values are less than, which is met long before the largest. Counting
// runs lane by lane, which takes less than half the time of moving values about.
NACRE_VECTOR_CLONES
void orderStatistics(const std::vector<float>& values, size_t rank, float& first, float& second)
{
    alignas(32) float padded[kFewValues];
    const size_t stride = (values.size() + kLanes - 1) / kLanes * kLanes;
    std::copy(values.begin(), values.end(), padded);
    std::fill(padded + values.size(), padded + stride, values.front());
    Lanes lowest = lanesAt(padded), most = lowest;
    for (size_t i = kLanes; i < stride; i += kLanes) {
        lowest = lanesAt(padded + i) < lowest ? lanesAt(padded + i) : lowest;
        most = lanesAt(padded + i) > most ? lanesAt(padded + i) : most;
    }
    std::fill(padded + values.size(), padded + stride, std::numeric_limits<float>::infinity());
    int64_t low = orderedBits(std::bit_cast<int32_t>(leastOf(lowest))),
            high = orderedBits(std::bit_cast<int32_t>(-leastOf(-most)));
    while (low < high) {
        const int64_t middle = low + (high - low + 1) / 2;
        const float limit = std::bit_cast<float>(orderedBits(static_cast<int32_t>(middle)));
        LaneCounts below = {};
        for (size_t i = 0; i < stride; i += kLanes) {
            below -= lanesAt(padded + i) < limit;
        }
        const size_t count = static_cast<size_t>(sumOf(below));
        low = count <= rank ? middle : low;
        high = count < rank ? high : count == rank ? low : middle - 1;
    }
    const float floor = std::bit_cast<float>(orderedBits(static_cast<int32_t>(low)));
    const Lanes none = allLanes(std::numeric_limits<float>::infinity());
    Lanes least = none, next = none;
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes value = lanesAt(padded + i), notBelow = value < floor ? none : value;
        least = notBelow < least ? notBelow : least;
    }
    first = leastOf(least);
    LaneCounts upTo = {};
    for (size_t i = 0; i < stride; i += kLanes) {
        const Lanes value = lanesAt(padded + i), above = value > first ? value : none;
        upTo -= value <= first;
        next = above < next ? above : next;
    }
    const bool isShared = static_cast<size_t>(sumOf(upTo)) > rank + 1 || rank + 1 == values.size();
    second = isShared ? first : leastOf(next);
}

} // namespace

float quantile(std::vector<float>& values, double q)
{
    assert(!values.empty());
    const double position = q * static_cast<double>(values.size() - 1);
    const size_t low = static_cast<size_t>(position);
    if (values.size() <= kFewValues) {
        float first, second;
        orderStatistics(values, low, first, second);
        return first + static_cast<float>(position - static_cast<double>(low)) * (second - first);
    }
    std::nth_element(values.begin(), values.begin() + low, values.end());
    const float first = values[low];
    if (low + 1 == values.size()) {
        return first;
    }
    const float second = *std::min_element(values.begin() + low + 1, values.end());
    return first + static_cast<float>(position - static_cast<double>(low)) * (second - first);
}

float peakOf(std::vector<float>& values)
{
    const float peak = values.empty() ? 0 : quantile(values, 0.99);
    return peak > 0 ? peak : 1;
}

float peakOf(std::span<const glm::vec3> radiance, size_t mostValues)
{
    std::vector<float> values;
    const size_t count = 3 * radiance.size(), step = std::max<size_t>(1, count / mostValues);
    values.reserve(count / step + 1);
    for (size_t i = 0; i < count; i += step) {
        values.push_back(radiance[i / 3][static_cast<int>(i % 3)]);
    }
    return peakOf(values);
}

float peakOf(const Image& radiance, std::span<const uint8_t> mask)
{
    std::vector<float> values;
    for (int y = 0; y < radiance.height; ++y) {
        for (int x = 0; x < radiance.width; ++x) {
            if (mask[static_cast<size_t>(y) * radiance.width + x]) {
                const glm::vec3 v = radiance.rgb(x, y);
                values.insert(values.end(), {v.x, v.y, v.z});
            }
        }
    }
    return peakOf(values);
}

float exposureOfPeak(double peak)
{
    constexpr double kSteps = 1024; // in a stop
    return static_cast<float>(std::round(kSteps * std::log2(0.9 / peak)) / kSteps);
}

double radiancePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask, double peak)
{
    return psnrOfClipped(a, b, mask, 1 / peak);
}

double picturePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask)
{
    return psnrOfClipped(a, b, mask, 1);
}

// atan2 of cross and dot: accurate for small angles, where acos is not.
double degreesBetween(const glm::vec3& a, const glm::vec3& b)
{
    const double cosine = glm::dot(a, b), sine = glm::length(glm::cross(a, b));
    return std::atan2(sine, cosine) * 180 / 3.14159265358979323846;
}

namespace {

int code(float value)
{
    return static_cast<int>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
}

} // namespace

CodeDifference codeDifference(const Image& a, const Image& b, std::span<const uint8_t> mask, int tolerance)
{
    assert(a.width == b.width && a.height == b.height && mask.size() == a.pixelCount());
    CodeDifference found;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            if (!mask[static_cast<size_t>(y) * a.width + x]) {
                continue;
            }
            const glm::vec3 left = a.rgb(x, y), right = b.rgb(x, y);
            int worst = 0;
            for (int c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(code(left[c]) - code(right[c])));
            }
            found.largest = std::max(found.largest, worst);
            found.beyond += worst > tolerance;
            ++found.pixels;
        }
    }
    return found;
}

CodeDifference codeDifference(const Image& a, const Image& b, int tolerance)
{
    return codeDifference(a, b, std::vector<uint8_t>(a.pixelCount(), 1), tolerance);
}

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
