#include "evaluation/rendering/bake_benchmark.h"

#include <array>

#include <nanoflann.hpp>

#include "acquisition/brdf/bake.h"
#include "engine/files/hash_random.h"
#include "engine/files/parallel_for.h"
#include "engine/files/stopwatch.h"

namespace nacre {

namespace {

constexpr size_t kSamples = 1000000;
constexpr size_t kPlanes = 96;
constexpr int kNeighbours = 25;
constexpr glm::ivec3 kSize{90, 90, 180};

BrdfSamples planeSamples()
{
    BrdfSamples samples;
    samples.domain = {kHalfDifference, kHalfPi / 2};
    for (size_t i = 0; i < kSamples; ++i) {
        const auto random = [&](uint64_t which) { return static_cast<float>(unitFromHash(hashOf(i, which))); };
        const float plane = (static_cast<float>(i % kPlanes) + 0.5f) / kPlanes;
        samples.unit.emplace_back(random(0), plane, random(1));
        samples.values.emplace_back(0.2f + random(2));
        samples.weights.push_back(0.5f + 0.5f * random(3));
    }
    return samples;
}

struct Points {
    std::vector<glm::vec4> points;

    size_t kdtree_get_point_count() const { return points.size(); }
    float kdtree_get_pt(size_t i, size_t axis) const { return points[i][static_cast<int>(axis)]; }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

glm::vec4 pointOf(const TableDomain& domain, const glm::vec3& unit)
{
    return embeddedPoint(embeddedConfiguration(domain, unit), {});
}

// Asks and forgets; the sum keeps the compiler from doing neither.
double queryAll(const BrdfSamples& samples, int threads)
{
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 4>;
    Points points;
    for (const glm::vec3& unit : samples.unit) {
        points.points.push_back(pointOf(samples.domain, unit));
    }
    Tree tree(4, points, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    tree.buildIndex();
    const glm::vec3 last = glm::vec3(kSize) - 1.0f;
    const size_t rows = static_cast<size_t>(kSize.y) * kSize.z;
    std::vector<double> sums(rows, 0);
    parallelFor(rows, 8, threads, [&](size_t first, size_t end) {
        std::array<uint32_t, kNeighbours> found;
        std::array<float, kNeighbours> squared;
        for (size_t row = first; row < end; ++row) {
            for (int i = 0; i < kSize.x; ++i) {
                const glm::vec3 unit = glm::vec3(i, row % kSize.y, row / kSize.y) / last;
                const glm::vec4 query = pointOf(samples.domain, unit);
                tree.knnSearch(&query.x, kNeighbours, found.data(), squared.data());
                sums[row] += squared[0];
            }
        }
    });
    double sum = 0;
    for (const double s : sums) {
        sum += s;
    }
    return sum;
}

} // namespace

BakeBenchmark benchmarkBake(int threads)
{
    const BrdfSamples samples = planeSamples();
    BakeBenchmark result{kSamples, static_cast<size_t>(kSize.x) * kSize.y * kSize.z, kNeighbours, 0, 0};
    volatile double kept = 0;
    result.bareQueries = secondsOf([&] { kept = queryAll(samples, threads); });
    InterpolationOptions interpolation{.k = kNeighbours, .threads = threads};
    result.bake = secondsOf([&] {
        const BakedBrdf baked = bakeBrdf(samples, interpolation, {.size = kSize, .threads = threads});
        kept = baked.table.values.front().x;
    });
    return result;
}

} // namespace nacre
