#include "engine/files/code_difference.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre {

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

} // namespace nacre
