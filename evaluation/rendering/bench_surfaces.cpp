#include "evaluation/rendering/bench_surfaces.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <nanoflann.hpp>

#include "acquisition/brdf/bake.h"
#include "engine/files/hash_random.h"
#include "engine/files/parallel_for.h"
#include "engine/files/stopwatch.h"

namespace nacre {
namespace {

// Normals in every pixel, in waves: neighbours differ as on a real surface.
NormalMap wavyNormals(int width, int height)
{
    NormalMap map(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float slopeX = 1.3f * std::sin(0.021f * x + 2 * std::sin(0.003f * y));
            const float slopeY = 1.3f * std::sin(0.017f * y);
            map.normals[map.index(x, y)] = glm::normalize(glm::vec3(slopeX, slopeY, 1));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    return map;
}

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

Image wavyHeight(int width, int height)
{
    Image waves(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            waves.at(x, y) = 62 * std::cos(0.021f * x + 2 * std::sin(0.003f * y)) - 76 * std::cos(0.017f * y);
        }
    }
    return waves;
}

Surface benchSurface(const PictureSize& size, const Material& material, bool modulated)
{
    Surface surface = transferredSurface(wavyNormals(size.width, size.height), material);
    if (!modulated) {
        return surface;
    }
    surface.materials.assign(4, material);
    surface.albedo = Image(size.width, size.height, 3);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        surface.labels[i] = static_cast<uint8_t>(i / 61 % 4);
        for (size_t c = 0; c < 3; ++c) {
            surface.albedo.values[3 * i + c] = 0.5f + 0.01f * static_cast<float>((i + 7 * c) % 100);
        }
    }
    return surface;
}

std::vector<Light> benchLights(int count, int turn)
{
    std::vector<Light> lights;
    for (int i = 0; i < count; ++i) {
        const float azimuth = 2.3999632f * i + 0.01f * turn, slope = 0.9f * std::sqrt((i + 0.5f) / count);
        lights.push_back({glm::normalize(glm::vec3(slope * std::cos(azimuth), slope * std::sin(azimuth), 1)),
                          glm::vec3(1.0f / count)});
    }
    return lights;
}

ResidualLayer benchResidual(const Surface& surface, int components, int captured)
{
    ResidualLayer layer;
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.components = components;
    layer.trust = 0.8f;
    layer.low.assign(components, -0.02f);
    layer.high.assign(components, 0.02f);
    for (const Light& light : benchLights(captured, 0)) {
        layer.nodes.push_back(light.direction);
    }
    for (size_t i = 0; i < components * layer.nodes.size(); ++i) {
        layer.weights.emplace_back(static_cast<float>(hashOf(i) % 1000) / 5000 - 0.1f);
    }
    layer.codes.resize(layer.layers() * layer.pixelCount() * kComponentsPerTexel);
    for (size_t i = 0; i < layer.codes.size(); ++i) {
        layer.codes[i] = static_cast<uint8_t>(hashOf(i));
    }
    return layer;
}

BakeBenchmark benchmarkBake(int threads)
{
    const BrdfSamples samples = planeSamples();
    BakeBenchmark result{kSamples, static_cast<size_t>(kSize.x) * kSize.y * kSize.z, kNeighbours, 0, 0};
    volatile double kept = 0;
    result.bareQueries = secondsOf([&] { kept = queryAll(samples, threads); });
    InterpolationOptions interpolation{.k = kNeighbours, .threads = threads};
    result.bake = secondsOf([&] {
        const BakedBrdf baked =
            bakeBrdf(samples, interpolation, {.coordinates = {}, .size = kSize, .threads = threads});
        kept = baked.table.values.front().x;
    });
    return result;
}

} // namespace nacre
