#include "acquisition/normals/triple_search.h"

#include <algorithm>
#include <cstring>

#include "acquisition/normals/lanes.h"
#include "acquisition/normals/pixel_batch.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Costs only grow: every so many lights it is asked whether any lane can still win.
constexpr size_t kLightsBetweenChecks = 16;
constexpr float kNoCost = 1e30f;
constexpr size_t kBatchesPerTask = 32;

NACRE_VECTOR_CLONES
void addCosts(const PixelBatch& batch, const BatchVector& g, const glm::vec3* directions, size_t first, size_t last,
              TripleCost kind, const float* limits, float* costs)
{
    const Lanes zero = {};
    const Lanes floor = zero + (kind == TripleCost::truncated ? 0.0f : -kNoCost);
    const Lanes limit = kind == TripleCost::truncated ? lanesAt(limits) : zero + kNoCost;
    const Lanes gx = lanesAt(g.x), gy = lanesAt(g.y), gz = lanesAt(g.z);
    Lanes sum = lanesAt(costs);
    for (size_t i = first; i < last; ++i) {
        const glm::vec3 l = directions[i];
        const Lanes line = l.x * gx + l.y * gy + l.z * gz;
        const Lanes difference = lanesAt(batch.ofLight(i)) - (line > floor ? line : floor);
        const Lanes distance = difference > zero ? difference : -difference;
        sum += distance < limit ? distance : limit;
    }
    std::memcpy(costs, &sum, sizeof sum);
}

BatchVector solveTriple(const PixelBatch& batch, const LightTriple& triple)
{
    const float *a = batch.ofLight(triple.a), *b = batch.ofLight(triple.b), *c = batch.ofLight(triple.c);
    const glm::mat3& m = triple.inverse;
    BatchVector g;
    for (int k = 0; k < kLanes; ++k) {
        g.x[k] = m[0].x * a[k] + m[1].x * b[k] + m[2].x * c[k];
        g.y[k] = m[0].y * a[k] + m[1].y * b[k] + m[2].y * c[k];
        g.z[k] = m[0].z * a[k] + m[1].z * b[k] + m[2].z * c[k];
    }
    return g;
}

bool anyBelow(const float* costs, const float* best)
{
    bool any = false;
    for (int k = 0; k < kLanes; ++k) {
        any |= costs[k] < best[k];
    }
    return any;
}

BatchVector searchBatch(const PixelBatch& batch, const std::vector<LightTriple>& triples,
                        const std::vector<glm::vec3>& directions, TripleCost kind, const float* limits)
{
    BatchVector best{};
    float bestCosts[kLanes];
    std::fill_n(bestCosts, kLanes, kNoCost);
    for (const LightTriple& triple : triples) {
        const BatchVector g = solveTriple(batch, triple);
        float costs[kLanes];
        for (int k = 0; k < kLanes; ++k) {
            costs[k] = g.z[k] > 0 ? 0.0f : kNoCost;
        }
        for (size_t i = 0; i < directions.size() && anyBelow(costs, bestCosts); i += kLightsBetweenChecks) {
            addCosts(batch, g, directions.data(), i, std::min(directions.size(), i + kLightsBetweenChecks), kind,
                     limits, costs);
        }
        for (int k = 0; k < kLanes; ++k) {
            if (costs[k] < bestCosts[k]) {
                bestCosts[k] = costs[k];
                best.x[k] = g.x[k];
                best.y[k] = g.y[k];
                best.z[k] = g.z[k];
            }
        }
    }
    return best;
}

} // namespace

std::vector<glm::vec3> findBestTriples(const Intensities& intensities, const std::vector<LightTriple>& triples,
                                       const std::vector<glm::vec3>& directions, TripleCost cost, float limitShare,
                                       int threads)
{
    std::vector<glm::vec3> best(intensities.pixelCount());
    parallelFor((best.size() + kLanes - 1) / kLanes, kBatchesPerTask, threads, [&](size_t first, size_t last) {
        PixelBatch batch(intensities.lightCount);
        for (size_t b = first; b < last; ++b) {
            float limits[kLanes] = {};
            const size_t count = std::min<size_t>(kLanes, best.size() - b * kLanes);
            for (size_t k = 0; k < count; ++k) {
                batch.set(static_cast<int>(k), intensities.ofPixel(b * kLanes + k));
                limits[k] = limitShare * brightLevel(intensities.ofPixel(b * kLanes + k));
            }
            const BatchVector g = searchBatch(batch, triples, directions, cost, limits);
            for (size_t k = 0; k < count; ++k) {
                best[b * kLanes + k] = {g.x[k], g.y[k], g.z[k]};
            }
        }
    });
    return best;
}

} // namespace nacre
