#include "assets/synth/bouncing_light.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_audit.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// What a pixel receives in the bowl is off by less than 1 % (tests/assets/interreflection_test.cpp).
constexpr int kNodes = 5000;

constexpr size_t kPointsPerTask = 64;

} // namespace

// The mean of the directional albedo a over cos dw, which is even in sin^2: 2 integral of a cos sin = integral of
// a d(sin^2).
glm::dvec3 meanAlbedo(const BrdfModel& material)
{
    constexpr int kAngles = 8;
    const BrdfFunction f = functionOf(material);
    glm::dvec3 sum(0);
    for (int i = 0; i < kAngles; ++i) {
        const double theta = std::asin(std::sqrt((i + 0.5) / kAngles));
        sum += glm::dvec3(directionalAlbedo(f, theta * 180 / std::numbers::pi).albedo);
    }
    return sum / static_cast<double>(kAngles);
}

BouncingLight bouncingLight(const BumpySolid& solid, const SolidView& view, const std::vector<BrdfModel>& materials,
                            int bounces, int threads)
{
    BouncingLight light;
    light.bounces = bounces;
    light.nodes = nodesOf(solid, kNodes);
    for (const BrdfModel& material : materials) {
        light.materialAlbedos.push_back(meanAlbedo(material));
    }
    for (const SurfaceNode& node : light.nodes) {
        light.albedos.push_back(light.materialAlbedos[patchMaterial(glm::normalize(node.place), materials.size())]);
    }
    const Sees sees = [&](const glm::dvec3& from, const glm::dvec3& to) { return solid.sees(from, to); };
    light.betweenNodes.resize(light.nodes.size());
    parallelFor(light.nodes.size(), kPointsPerTask, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            light.betweenNodes[i] = formFactorsAt(light.nodes[i].place, light.nodes[i].normal, light.nodes, sees);
        }
    });
    light.toPixels.resize(view.seen.size());
    parallelFor(view.seen.size(), kPointsPerTask, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const glm::dvec3 normal(view.normals.normals[view.seen[i]]);
            light.toPixels[i] = formFactorsAt(view.surfacePoint(view.seen[i]), normal, light.nodes, sees);
        }
    });
    return light;
}

} // namespace nacre
