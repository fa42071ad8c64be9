#include "engine/brdf/compact_brdf.h"

#include <algorithm>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nacre {

namespace {

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
        domain.coordinates == kHalfDifference ? domain.thetaDMax / table.domain.thetaDMax : 1.0f; // of unit.y
    constexpr float kRounding = 1e-5f;
    BrdfTable resampled(size, domain);
    for (size_t texel = 0; texel < resampled.values.size(); ++texel) {
        glm::vec3 unit = unitOfTexel(resampled, texel);
        unit.y *= stretch;
        const BrdfValue value = sampleTable(table, glm::min(unit, glm::vec3(1)));
        resampled.values[texel] = value.value;
        resampled.confidence[texel] = unit.y <= 1 + kRounding ? value.confidence : 0;
    }
    return resampled;
}

BrdfTable expandedTable(const CompactBrdf& model, const BrdfTable& covered)
{
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        BrdfTable table = small->table;
        table.confidence = resampledTable(covered, table.size, table.domain).confidence;
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
