#include "engine/brdf/texel_format.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/gtc/packing.hpp>

#include "engine/files/error.h"

namespace nacre {

namespace {

constexpr float kLargestHalf = 65504;
constexpr float kLargestShared = 65408; // 511/512 of 2^16

// Khronos Data Format Specification 1.3, 10.3 (shared exponent): 9 bits a mantissa, exponent bias 15. GLM's own packing
// loses the exponent of large values.
glm::vec3 throughSharedExponent(const glm::vec3& v)
{
    constexpr int kBits = 9, kBias = 15;
    const float largest = std::max(v.x, std::max(v.y, v.z));
    int exponent = std::max(-kBias - 1, largest > 0 ? std::ilogb(largest) : -kBias - 1) + 1;
    if (std::floor(std::ldexp(largest, kBits - exponent) + 0.5f) >= 1 << kBits) {
        ++exponent; // rounding carries over
    }
    const auto rounded = [&](float x) {
        return std::ldexp(std::floor(std::ldexp(x, kBits - exponent) + 0.5f), exponent - kBits);
    };
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

} // namespace

float throughHalf(float value)
{
    return glm::unpackHalf1x16(glm::packHalf1x16(std::clamp(value, -kLargestHalf, kLargestHalf)));
}

std::string nameOf(TexelFormat format)
{
    switch (format) {
    case TexelFormat::rgba32f:
        return "RGBA32F";
    case TexelFormat::rgba16f:
        return "RGBA16F";
    case TexelFormat::e5b9g9r9:
        break;
    }
    return "E5B9G9R9";
}

TexelFormat texelFormatFromName(const std::string& name)
{
    for (const auto format : {TexelFormat::rgba32f, TexelFormat::rgba16f, TexelFormat::e5b9g9r9}) {
        if (name == nameOf(format)) {
            return format;
        }
    }
    throw Error("", "texel format " + name + " is unknown", "RGBA32F, RGBA16F or E5B9G9R9");
}

size_t bytesPerTexel(TexelFormat format)
{
    switch (format) {
    case TexelFormat::rgba32f:
        return 16;
    case TexelFormat::rgba16f:
        return 8;
    case TexelFormat::e5b9g9r9:
        break;
    }
    return 4;
}

glm::vec3 quantised(const glm::vec3& value, TexelFormat format)
{
    const glm::vec3 v = glm::max(value, glm::vec3(0));
    switch (format) {
    case TexelFormat::rgba32f:
        return v;
    case TexelFormat::rgba16f:
        return {throughHalf(v.x), throughHalf(v.y), throughHalf(v.z)};
    case TexelFormat::e5b9g9r9:
        break;
    }
    return throughSharedExponent(glm::min(v, glm::vec3(kLargestShared)));
}

} // namespace nacre
