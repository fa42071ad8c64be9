#pragma once
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/brdf/brdf_models.h"
#include "engine/brdf/brdf_table.h"

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

// Smaller descriptions of a material than its full table, each enough to make a table from (expandedTable).

// f = kD / pi + a lobe; A = 0: Lambert.
struct FittedLobe {
    AbcModel model;
};

// A table of fewer texels, or of shorter ones; size.z = 1: bivariate, f(thetaH, thetaD). Holds quantised values.
struct SmallTable {
    BrdfTable table;
    TexelFormat format = TexelFormat::rgba32f;
};

using CompactBrdf = std::variant<FittedLobe, SmallTable>;

// "Lambert", "Lambert + lobe", "bivariate", "table".
std::string nameOf(const CompactBrdf& model);
// The same with the table's size and format, where it has one: "table 64x12x12 RGBA16F".
std::string describe(const CompactBrdf& model);
// Of what it takes in memory, coverage apart.
size_t bytesOf(const CompactBrdf& model);

// The table that the renderer looks up, with coverage and expected error of `covered`: a small table as it is, a lobe
// on covered's grid. f is never negative.
BrdfTable expandedTable(const CompactBrdf& model, const BrdfTable& covered);

// `table` on another grid, trilinear; domains differ in thetaDMax alone. What lies beyond the table's own range has its
// border's values, confidence 0 and, where errors are told, at least kUnknownError.
BrdfTable resampledTable(const BrdfTable& table, const glm::ivec3& size, const TableDomain& domain);

} // namespace nacre
