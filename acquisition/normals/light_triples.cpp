#include "acquisition/normals/light_triples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <span>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/files/hash_random.h"
#include "engine/files/lanes.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Intensities of a few pixels side by side, so that one instruction serves all of them. Every lane is computed alone:
// results do not depend on the machine's vector width.
struct PixelBatch {
    size_t lights = 0;
    std::vector<float> values; // [light * kLanes + lane]

    explicit PixelBatch(size_t lightCount) : lights(lightCount), values(lightCount * kLanes, 0.0f) {}
    const float* ofLight(size_t light) const { return &values[light * kLanes]; }
    void set(int lane, std::span<const float> intensities)
    {
        for (size_t i = 0; i < lights; ++i) {
            values[i * kLanes + lane] = intensities[i];
        }
    }
};

// A vector of each lane.
struct BatchVector {
    float x[kLanes];
    float y[kLanes];
    float z[kLanes];
};

// Triples of a smaller determinant (of unit vectors) lie in one plane as far as float can tell.
constexpr float kSmallestDeterminant = 1e-4f;
// Drawn for each triple that is kept: the median splits them.
constexpr size_t kDrawnPerKept = 2;

using Indices = std::array<int, 3>;

glm::mat3 matrixOf(const std::vector<Light>& lights, const Indices& t)
{
    // Rows are directions; glm is column-major.
    return glm::transpose(glm::mat3(lights[t[0]].direction, lights[t[1]].direction, lights[t[2]].direction));
}

float volume(const std::vector<Light>& lights, const Indices& t)
{
    return std::abs(glm::determinant(matrixOf(lights, t)));
}

std::vector<Indices> allTriples(int n)
{
    std::vector<Indices> triples;
    for (int a = 0; a < n; ++a) {
        for (int b = a + 1; b < n; ++b) {
            for (int c = b + 1; c < n; ++c) {
                triples.push_back({a, b, c});
            }
        }
    }
    return triples;
}

std::vector<Indices> drawnTriples(const std::vector<Light>& lights, size_t most, uint64_t seed)
{
    std::set<Indices> drawn;
    while (drawn.size() < most * kDrawnPerKept) {
        Indices t;
        for (int& index : t) {
            index = static_cast<int>(nextRandom(seed) % lights.size());
        }
        std::sort(t.begin(), t.end());
        if (t[0] != t[1] && t[1] != t[2]) {
            drawn.insert(t);
        }
    }
    std::vector<Indices> triples(drawn.begin(), drawn.end());
    std::stable_sort(triples.begin(), triples.end(),
                     [&](const Indices& s, const Indices& t) { return volume(lights, s) > volume(lights, t); });
    triples.resize(most);
    return triples;
}

} // namespace

std::vector<glm::vec3> directionsOf(const std::vector<Light>& lights)
{
    std::vector<glm::vec3> directions;
    for (const Light& light : lights) {
        directions.push_back(light.direction);
    }
    return directions;
}

std::vector<LightTriple> makeLightTriples(const std::vector<Light>& lights, size_t most, uint64_t seed)
{
    const size_t n = lights.size();
    const size_t all = n * (n - 1) * (n - 2) / 6;
    // Twice as many draws must exist for the better half to be one.
    const bool draw = all > most * kDrawnPerKept * 2;
    std::vector<Indices> chosen = draw ? drawnTriples(lights, most, seed) : allTriples(static_cast<int>(n));
    if (!draw && chosen.size() > most) {
        std::stable_sort(chosen.begin(), chosen.end(),
                         [&](const Indices& s, const Indices& t) { return volume(lights, s) > volume(lights, t); });
        chosen.resize(most);
    }
    std::vector<LightTriple> triples;
    for (const Indices& t : chosen) {
        if (volume(lights, t) > kSmallestDeterminant) {
            triples.push_back({t[0], t[1], t[2], glm::inverse(matrixOf(lights, t))});
        }
    }
    return triples;
}

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
        const Lanes observed = lanesAt(batch.ofLight(i)), difference = observed - (line > floor ? line : floor);
        const Lanes distance = difference > zero ? difference : -difference;
        const Lanes counted = distance < limit ? distance : limit;
        sum += observed == observed ? counted : zero; // clipped observations are no numbers
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
