#include "engine/brdf/compact_brdf.h"

#include <algorithm>
#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nacre {

namespace {

template <class... Ts> struct Overloaded : Ts... {
    using Ts::operator()...;
};
template <class... Ts> Overloaded(Ts...) -> Overloaded<Ts...>;

glm::vec3 unitOfTexel(const BrdfTable& table, size_t texel)
{
    const size_t x = static_cast<size_t>(table.size.x), y = static_cast<size_t>(table.size.y);
    const glm::vec3 index(texel % x, texel / x % y, texel / (x * y));
    return index / glm::max(glm::vec3(table.size) - 1.0f, glm::vec3(1.0f));
}

// On the grid and with the coverage of `covered`.
template <class Value> BrdfTable tableOnGrid(const BrdfTable& covered, Value&& valueOfTexel)
{
    BrdfTable table = covered;
    for (size_t texel = 0; texel < table.values.size(); ++texel) {
        table.values[texel] = glm::max(valueOfTexel(texel), glm::vec3(0));
    }
    return table;
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

glm::vec3 lowRankValue(const LowRankTable& model, size_t texel)
{
    const size_t x = static_cast<size_t>(model.size.x), slice = texel / x, i = texel % x;
    const size_t sliceSize = static_cast<size_t>(model.size.y) * model.size.z;
    glm::vec3 sum(0);
    for (int r = 0; r < model.rank; ++r) {
        const float weight = model.slices[r * sliceSize + slice];
        for (int c = 0; c < 3; ++c) {
            sum[c] += model.profiles[(size_t{3} * r + c) * x + i] * weight;
        }
    }
    return sum;
}

glm::vec3 combinedValue(const BasisBrdf& model, size_t texel)
{
    const std::vector<float>& components = model.basis->components;
    const size_t rank = static_cast<size_t>(model.basis->rank), texels = components.size() / rank;
    glm::vec3 sum(0);
    for (size_t r = 0; r < rank; ++r) {
        for (size_t c = 0; c < 3; ++c) {
            sum[static_cast<int>(c)] += model.coefficients[r * 3 + c] * components[r * texels + texel];
        }
    }
    return sum;
}

} // namespace

std::string nameOf(const CompactBrdf& model)
{
    return std::visit(
        Overloaded{
            [](const FittedLobe& m) -> std::string { return m.model.A == glm::vec3(0) ? "Lambert" : "Lambert + lobe"; },
            [](const SmallTable& m) -> std::string { return m.table.size.z == 1 ? "bivariate" : "table"; },
            [](const LowRankTable& m) { return fmt::format("rank {}", m.rank); },
            [](const BasisBrdf& m) {
                return fmt::format("{} component{}", m.basis->rank, m.basis->rank == 1 ? "" : "s");
            }},
        model);
}

std::string describe(const CompactBrdf& model)
{
    const auto text = [](const glm::ivec3& s) {
        return s.z == 1 ? fmt::format("{}x{}", s.x, s.y) : fmt::format("{}x{}x{}", s.x, s.y, s.z);
    };
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        return fmt::format("{} {} {}", nameOf(model), text(small->table.size), nameOf(small->format));
    }
    if (const auto* combined = std::get_if<BasisBrdf>(&model)) {
        return fmt::format("{} {} R16F", nameOf(model), text(combined->basis->size));
    }
    return nameOf(model);
}

size_t bytesOf(const BrdfBasis& basis)
{
    const size_t half = 2;
    return half * basis.components.size();
}

size_t bytesOf(const CompactBrdf& model)
{
    return std::visit(
        Overloaded{[](const FittedLobe& m) {
                       const size_t diffuse = 3, lobe = 6; // kD; A, B, C, ior
                       return sizeof(float) * (m.model.A == glm::vec3(0) ? diffuse : diffuse + lobe);
                   },
                   [](const SmallTable& m) { return m.table.values.size() * bytesPerTexel(m.format); },
                   [](const LowRankTable& m) { return sizeof(float) * (m.profiles.size() + m.slices.size()); },
                   [](const BasisBrdf& m) { return bytesOf(*m.basis) + sizeof(float) * m.coefficients.size(); }},
        model);
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
    return std::visit(Overloaded{[&](const FittedLobe& m) {
                                     return tableOnGrid(covered, [&](size_t texel) {
                                         return lobeAt(m.model,
                                                       directionsFromUnit(covered.domain, unitOfTexel(covered, texel)));
                                     });
                                 },
                                 [&](const SmallTable& m) {
                                     BrdfTable table = m.table;
                                     table.confidence = resampledTable(covered, table.size, table.domain).confidence;
                                     return table;
                                 },
                                 [&](const LowRankTable& m) {
                                     const BrdfTable grid =
                                         covered.size == m.size ? covered : resampledTable(covered, m.size, m.domain);
                                     return tableOnGrid(grid, [&](size_t texel) { return lowRankValue(m, texel); });
                                 },
                                 [&](const BasisBrdf& m) {
                                     return tableOnGrid(resampledTable(covered, m.basis->size, m.basis->domain),
                                                        [&](size_t texel) { return combinedValue(m, texel); });
                                 }},
                      model);
}

} // namespace nacre
