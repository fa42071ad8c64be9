#include "engine/brdf/brdf_tabulation.h"

#include <array>

#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr vec3 kNormal(0, 0, 1);

// Models whose formula is symmetric need no mean: one configuration stands for all.
bool isSymmetric(const BrdfModel& model)
{
    const BrdfTable* table = tableOf(model);
    return table ? table->domain.coordinates == kHalfDifference
                 : !std::holds_alternative<std::shared_ptr<const RglBrdf>>(model);
}

BrdfValue valueAt(const BrdfModel& model, const LightView& d)
{
    return evaluateCovered(model, kNormal, d.l, d.v);
}

BrdfValue texelValue(const BrdfModel& model, const TableDomain& domain, const vec3& unit)
{
    if (domain.coordinates == kNatural) {
        return valueAt(model, directionsFromNatural(naturalFromUnit(unit)));
    }
    const HalfDifference c = halfDifferenceFromUnit(unit, domain);
    return domain.coordinates == kOneWay ? valueAt(model, directionsFromHalfDifference(c)) : foldedValue(model, c);
}

template <class Visit> void forEachNeighbour(const BrdfTable& table, size_t texel, Visit&& visit)
{
    const glm::ivec3 size = table.size;
    const glm::ivec3 at(texel % size.x, texel / size.x % size.y, texel / size.x / size.y);
    const std::array<size_t, 3> steps{1, static_cast<size_t>(size.x), static_cast<size_t>(size.x) * size.y};
    for (int axis = 0; axis < 3; ++axis) {
        if (at[axis] > 0) {
            visit(texel - steps[axis]);
        }
        if (at[axis] + 1 < size[axis]) {
            visit(texel + steps[axis]);
        }
    }
}

constexpr int kUnknown = -1;

// Texels of the level after `level` that touch one of `frontier`.
std::vector<size_t> nextFrontier(const BrdfTable& table, const std::vector<size_t>& frontier, int level,
                                 std::vector<int>& levels)
{
    std::vector<size_t> next;
    for (size_t texel : frontier) {
        forEachNeighbour(table, texel, [&](size_t neighbour) {
            if (levels[neighbour] == kUnknown) {
                levels[neighbour] = level + 1;
                next.push_back(neighbour);
            }
        });
    }
    return next;
}

} // namespace

BrdfValue foldedValue(const BrdfModel& model, const HalfDifference& coordinates)
{
    const float phi = coordinates.phiD;
    const std::array<float, 4> equal{phi, -phi, phi - kPi, kPi - phi};
    const size_t count = isSymmetric(model) ? 1 : equal.size();
    vec3 sum(0);
    float weight = 0, confidence = 0;
    for (size_t i = 0; i < count; ++i) {
        const LightView d = directionsFromHalfDifference({coordinates.thetaH, coordinates.thetaD, equal[i]});
        const BrdfValue f = evaluateCovered(model, kNormal, d.l, d.v);
        sum += f.confidence * f.value;
        weight += f.confidence;
        confidence = max(confidence, f.confidence);
    }
    return {weight > 0 ? sum / weight : vec3(0), confidence};
}

BrdfTable tabulatedBrdf(const BrdfModel& model, const glm::ivec3& size, const TableDomain& domain, int threads)
{
    BrdfTable table(size, domain);
    const vec3 last = glm::max(vec3(size) - 1.0f, vec3(1.0f));
    parallelFor(static_cast<size_t>(size.y) * size.z, 8, threads, [&](size_t first, size_t end) {
        for (size_t row = first; row < end; ++row) {
            const int j = static_cast<int>(row % size.y), k = static_cast<int>(row / size.y);
            for (int i = 0; i < size.x; ++i) {
                const BrdfValue f = texelValue(model, domain, vec3(i, j, k) / last);
                table.values[table.index(i, j, k)] = f.value;
                table.confidence[table.index(i, j, k)] = f.confidence;
            }
        }
    });
    fillUncovered(table);
    return table;
}

void fillUncovered(BrdfTable& table)
{
    std::vector<int> levels(table.values.size(), kUnknown);
    std::vector<size_t> frontier;
    for (size_t i = 0; i < levels.size(); ++i) {
        if (table.confidence[i] > 0) {
            levels[i] = 0;
            frontier.push_back(i);
        }
    }
    for (int level = 0; !frontier.empty(); ++level) {
        frontier = nextFrontier(table, frontier, level, levels);
        for (size_t texel : frontier) {
            vec3 sum(0);
            float count = 0;
            forEachNeighbour(table, texel, [&](size_t neighbour) {
                if (levels[neighbour] != kUnknown && levels[neighbour] <= level) {
                    sum += table.values[neighbour];
                    count += 1;
                }
            });
            table.values[texel] = sum / count;
        }
    }
}

} // namespace nacre
