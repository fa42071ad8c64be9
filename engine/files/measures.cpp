#include "engine/files/measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

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

} // namespace

float quantile(std::vector<float>& values, double q)
{
    assert(!values.empty());
    const double position = q * static_cast<double>(values.size() - 1);
    const size_t low = static_cast<size_t>(position);
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
    return static_cast<float>(std::log2(0.9 / peak));
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

} // namespace nacre
