#include "engine/brdf/compact_brdf.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>

#include "engine/files/error.h"
#include "shared/coverage.h"

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

glm::vec3 unitOfTexel(const BrdfTable& table, size_t texel)
{
    const size_t x = static_cast<size_t>(table.size.x), y = static_cast<size_t>(table.size.y);
    const glm::vec3 index(texel % x, texel / x % y, texel / (x * y));
    return index / glm::max(glm::vec3(table.size) - 1.0f, glm::vec3(1.0f));
}

// Light or view can be below the horizon in a corner of the grid; there the lobe's value at the horizon will do.
glm::vec3 lobeAt(const AbcModel& model, const LightView& directions)
{
    static constexpr float kGrazingCosine = 1e-3f;
    const auto above = [](glm::vec3 d) {
        d.z = std::max(d.z, kGrazingCosine);
        return glm::normalize(d);
    };
    return evaluate(model, {0, 0, 1}, above(directions.l), above(directions.v));
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

std::string nameOf(const CompactBrdf& model)
{
    if (const auto* lobe = std::get_if<FittedLobe>(&model)) {
        return lobe->model.A == glm::vec3(0) ? "Lambert" : "Lambert + lobe";
    }
    return std::get<SmallTable>(model).table.size.z == 1 ? "bivariate" : "table";
}

std::string describe(const CompactBrdf& model)
{
    const auto text = [](const glm::ivec3& s) {
        return s.z == 1 ? fmt::format("{}x{}", s.x, s.y) : fmt::format("{}x{}x{}", s.x, s.y, s.z);
    };
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        return fmt::format("{} {} {}", nameOf(model), text(small->table.size), nameOf(small->format));
    }
    return nameOf(model);
}

size_t bytesOf(const CompactBrdf& model)
{
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        return small->table.values.size() * bytesPerTexel(small->format);
    }
    const size_t diffuse = 3, lobe = 6; // kD; A, B, C, ior
    return sizeof(float) * (std::get<FittedLobe>(model).model.A == glm::vec3(0) ? diffuse : diffuse + lobe);
}

BrdfTable resampledTable(const BrdfTable& table, const glm::ivec3& size, const TableDomain& domain)
{
    const float stretch =
        domain.coordinates != kNatural ? domain.thetaDMax / table.domain.thetaDMax : 1.0f; // of unit.y
    constexpr float kRounding = 1e-5f;
    BrdfTable resampled(size, domain);
    resampled.error.resize(table.error.empty() ? 0 : resampled.values.size());
    for (size_t texel = 0; texel < resampled.values.size(); ++texel) {
        glm::vec3 unit = unitOfTexel(resampled, texel);
        unit.y *= stretch;
        const bool isWithin = unit.y <= 1 + kRounding;
        unit = glm::min(unit, glm::vec3(1));
        const BrdfValue value = sampleTable(table, unit);
        resampled.values[texel] = value.value;
        resampled.confidence[texel] = isWithin ? value.confidence : 0;
        if (!table.error.empty()) {
            resampled.error[texel] = std::max(sampleError(table, unit), isWithin ? 0 : kUnknownError);
        }
    }
    return resampled;
}

BrdfTable expandedTable(const CompactBrdf& model, const BrdfTable& covered)
{
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        BrdfTable table = small->table;
        const BrdfTable resampled = resampledTable(covered, table.size, table.domain);
        table.confidence = resampled.confidence;
        table.error = resampled.error;
        return table;
    }
    const AbcModel& lobe = std::get<FittedLobe>(model).model;
    BrdfTable table = covered;
    for (size_t texel = 0; texel < table.values.size(); ++texel) {
        const LightView directions = directionsFromUnit(covered.domain, unitOfTexel(covered, texel));
        table.values[texel] = glm::max(lobeAt(lobe, directions), glm::vec3(0));
    }
    return table;
}

} // namespace nacre
