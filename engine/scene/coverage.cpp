#include "engine/scene/coverage.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace {

constexpr size_t kMostPairs = 4'000'000; // of pixel and light: a fraction of a second
constexpr size_t kLeastPixels = 400;
constexpr size_t kGrain = 64; // pixels of one partial sum

// Summed in the order of the grains, so that the share does not depend on threads.
struct Counts {
    size_t lit = 0, asking = 0;               // pixels
    double reaching = 0, unmeasuredLight = 0; // sums of n.l
};

// Null where nothing of the material's can be beyond what was measured.
const BrdfTable* tableToAsk(const Material& material)
{
    const BrdfTable& table = material.table;
    const auto covered = [](float confidence) { return confidence >= kCoveredConfidence; };
    const bool isWhole = std::all_of(table.confidence.begin(), table.confidence.end(), covered) &&
                         (table.domain.coordinates == kNatural || table.domain.thetaDMax >= kHalfPi);
    return isWhole || !knowsCoverage(table) ? nullptr : &table;
}

void countPixel(Counts& counts, const BrdfTable* table, const Surface& pixels, size_t pixel, const Scene& scene)
{
    const glm::vec3& n = pixels.normals.normals[pixel];
    bool isLit = false, asks = false;
    for (const Light& light : scene.lights) {
        const float nDotL = glm::dot(n, light.direction);
        if (nDotL <= 0 || glm::dot(n, scene.view) <= 0 || light.irradiance == glm::vec3(0)) {
            continue;
        }
        if (visibilityOf(pixels.horizon, horizonLookup(light.direction, pixels.horizon.azimuths), pixel) == 0) {
            continue;
        }
        const bool unmeasured = table != nullptr && asksUnmeasured(*table, n, light.direction, scene.view);
        isLit = true;
        asks = asks || unmeasured;
        counts.reaching += nDotL;
        counts.unmeasuredLight += unmeasured ? nDotL : 0;
    }
    counts.lit += isLit;
    counts.asking += asks;
}

} // namespace

bool knowsCoverage(const BrdfTable& table)
{
    return std::any_of(table.confidence.begin(), table.confidence.end(), [](float c) { return c > 0; });
}

bool asksUnmeasured(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v)
{
    const float thetaD = halfDifferenceFromDirections(n, l, v).thetaD;
    const float coverage = evaluateTable(table, n, l, v).confidence;
    return !isMeasured(coverage, thetaD, table.domain.coordinates, table.domain.thetaDMax);
}

UnmeasuredShare unmeasuredShare(const Scene& scene, int threads)
{
    std::vector<const BrdfTable*> tables;
    for (const Material& material : scene.surface.materials) {
        tables.push_back(tableToAsk(material));
    }
    if (scene.lights.empty() || std::all_of(tables.begin(), tables.end(), [](auto t) { return t == nullptr; })) {
        return {};
    }
    const Surface pixels = sampledPixels(scene.surface, std::max(kLeastPixels, kMostPairs / scene.lights.size()));
    std::vector<Counts> grains(pixels.labels.size() / kGrain + 1);
    parallelFor(pixels.labels.size(), kGrain, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            if (pixels.normals.confidence[i] > 0) {
                countPixel(grains[first / kGrain], tables[pixels.labels[i]], pixels, i, scene);
            }
        }
    });
    Counts sum;
    for (const Counts& grain : grains) {
        sum.lit += grain.lit, sum.asking += grain.asking;
        sum.reaching += grain.reaching, sum.unmeasuredLight += grain.unmeasuredLight;
    }
    return sum.lit == 0 ? UnmeasuredShare{}
                        : UnmeasuredShare{static_cast<double>(sum.asking) / static_cast<double>(sum.lit),
                                          sum.unmeasuredLight / sum.reaching};
}

} // namespace nacre
