#pragma once
#include <cstddef>
#include <string>

#include <glm/vec3.hpp>

namespace nacre {

// How a table's f is kept in memory on a device; coverage is apart.
enum class TexelFormat {
    rgba32f,  // 16 bytes
    rgba16f,  // 8 bytes: 11 bits of precision to 65504
    e5b9g9r9, // 4 bytes: three 9-bit mantissas under one exponent, to 65408 (Vulkan, E5B9G9R9_UFLOAT_PACK32)
};

std::string nameOf(TexelFormat format);                   // "RGBA32F", "RGBA16F", "E5B9G9R9"
TexelFormat texelFormatFromName(const std::string& name); // throws Error (data)
size_t bytesPerTexel(TexelFormat format);

// Rounded to 16 bits; +-65504 at most.
float throughHalf(float value);

// What is left of a value once the format has held it; not negative, finite.
glm::vec3 quantised(const glm::vec3& value, TexelFormat format);

} // namespace nacre
