#include "acquisition/brdf/bake.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

const float kRadian = 180.0f / kPi; // degrees

// Largest extent of the texel around `unit` in raw angles, radians: the reach of one sample.
float texelDiagonal(const TableDomain& domain, const glm::vec3& unit, const glm::ivec3& size)
{
    const glm::vec3 step = 1.0f / glm::max(glm::vec3(size) - 1.0f, glm::vec3(1.0f));
    if (domain.coordinates == kNatural) {
        return glm::length(step * glm::vec3(kHalfPi, kHalfPi, kPi));
    }
    const float thetaH = (2 * unit.x + step.x) * step.x * kHalfPi; // of x^2 over one step
    return glm::length(glm::vec3(thetaH, step.y * domain.thetaDMax, step.z * largestPhiD(domain.coordinates)));
}

void countSamples(const BrdfSamples& samples, const BrdfTable& table, std::vector<float>& count)
{
    const glm::vec3 last = glm::vec3(table.size) - 1.0f;
    for (const glm::vec3& unit : samples.unit) {
        const glm::ivec3 texel(unit * last + 0.5f);
        count[table.index(texel.x, texel.y, texel.z)] += 1;
    }
}

} // namespace

TableDomain capturedDomain(const std::vector<Light>& lights, int coordinates)
{
    float thetaD = 0;
    for (const Light& light : lights) {
        thetaD = std::max(thetaD, 0.5f * angleBetween(light.direction, glm::vec3(0, 0, 1)));
    }
    // A capture with all lights at the camera still needs a grid.
    return {coordinates, std::clamp(thetaD, 1 / kRadian, kHalfPi)};
}

TableRange tableRangeFromName(const std::string& name)
{
    if (name == "captured") {
        return TableRange::captured;
    }
    if (name == "front" || name == "full") {
        return name == "front" ? TableRange::front : TableRange::full;
    }
    throw Error("", "table range " + name + " is unknown", "captured, front or full", Error::kUsage);
}

TableDomain tableDomain(const std::vector<Light>& lights, TableRange range, int coordinates)
{
    TableDomain domain = capturedDomain(lights, coordinates);
    if (range != TableRange::captured) {
        domain.thetaDMax = std::max(domain.thetaDMax, range == TableRange::front ? kHalfPi / 2 : kHalfPi);
    }
    return domain;
}

glm::ivec3 tableSize(const TableDomain& domain)
{
    if (domain.coordinates == kNatural) {
        return {90, 90, 90};
    }
    const int polar = std::max(2, static_cast<int>(std::ceil(domain.thetaDMax * kRadian)) + 1);
    return {kThetaHTexels, polar, phiDTexels(domain)};
}

glm::ivec3 coarseTableSize(const TableDomain& domain)
{
    return glm::max((tableSize(domain) + 1) / 2, glm::ivec3(2));
}

BakedBrdf bakeBrdf(const BrdfSamples& samples, const InterpolationOptions& interpolation, const BakeOptions& options)
{
    return bakeBrdf(samples, makeInterpolant(samples, interpolation), options);
}

BakedBrdf bakeBrdf(const BrdfSamples& samples, const BrdfInterpolant& interpolant, const BakeOptions& options)
{
    const glm::ivec3 size = options.size.x > 0 ? options.size : tableSize(samples.domain);
    BakedBrdf baked{BrdfTable(size, samples.domain), {}};
    BrdfTable& table = baked.table;
    baked.coverage.distance.resize(table.values.size());
    baked.coverage.count.assign(table.values.size(), 0.0f);
    table.error.resize(table.values.size());
    const glm::vec3 last = glm::max(glm::vec3(size) - 1.0f, glm::vec3(1.0f));
    parallelFor(static_cast<size_t>(size.y) * size.z, 8, options.threads, [&](size_t first, size_t end) {
        for (size_t row = first; row < end; ++row) {
            const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
            for (int i = 0; i < size.x; ++i) {
                const glm::vec3 unit = glm::vec3(i, j, k) / last;
                const InterpolatedValue value = interpolant(unit);
                const size_t texel = table.index(i, j, k);
                table.values[texel] = value.value;
                table.confidence[texel] =
                    std::min(1.0f, texelDiagonal(samples.domain, unit, size) / std::max(value.nearest, 1e-9f));
                baked.coverage.distance[texel] = value.nearest;
                table.error[texel] = value.error;
            }
        }
    });
    if (table.error.front() <= 0) {
        table.error.clear();
    }
    countSamples(samples, table, baked.coverage.count);
    return baked;
}

} // namespace nacre
