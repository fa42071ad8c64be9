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
