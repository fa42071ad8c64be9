#include "acquisition/cast_shadows/shadow_height.h"

#include <algorithm>

#include "acquisition/cast_shadows/shadow_lines.h"
#include "engine/files/parallel_for.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/height_springs.h"
#include "engine/surface/object_places.h"

namespace nacre {

namespace {

// Half or twice the solves, the slope's error, the ray's weight or the tolerance at first moves photographs of bear and
// Hermes that were left out by 0.2 dB at most.
constexpr int kSolves = 6;
constexpr double kSlopeError = 0.5;     // of a normal that faces the camera; beyond it there is a step
constexpr double kLeastWeight = 1e-4;   // of a spring that has given way
constexpr double kRayWeight = 0.05;     // beside a pair of neighbours that face the camera
constexpr double kRayError = 2;         // pixels: borders of shadows are known to about one, what casts them to another
constexpr double kRayErrorShare = 0.05; // of the rise, by the light's direction
constexpr double kWide = 10;            // times as tolerant in the first rounds, which start without steps
constexpr double kSolverTolerance = 1e-3; // of the equations' residual, relative
constexpr int kMostIterations = 60;

double cauchy(double error, double scale)
{
    return 1 / (1 + error * error / (scale * scale));
}

// So many lights tell where nothing stands in the way; more say the same.
constexpr size_t kMostLitLights = 32;

std::vector<size_t> evenly(std::span<const size_t> lights, size_t most)
{
    std::vector<size_t> chosen;
    const size_t stride = (lights.size() + most - 1) / most;
    for (size_t i = 0; i < lights.size(); i += std::max<size_t>(1, stride)) {
        chosen.push_back(lights[i]);
    }
    return chosen;
}

// One a light.
using Rays = std::vector<std::vector<GrazingRay>>;

template <class Trace> Rays traced(std::span<const size_t> by, int threads, Trace&& trace)
{
    Rays rays(by.size());
    parallelFor(by.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            rays[i] = trace(by[i]);
        }
    });
    return rays;
}

// The normals' springs, those that give way weaker. Their weights are inverse variances, of 1 for a normal that faces
// the camera.
HeightSprings weakened(HeightSprings springs, const std::vector<double>& height)
{
    const auto weaken = [&](size_t from, size_t to, double rise, double& weight) {
        if (weight > 0) {
            weight = std::max(kLeastWeight,
                              weight * cauchy(height[to] - height[from] - rise, kSlopeError / std::sqrt(weight)));
        }
    };
    for (size_t i = 0; i < height.size(); ++i) {
        weaken(i, i + 1, springs.riseRight[i], springs.grid.right[i]);
        weaken(i, i + static_cast<size_t>(springs.grid.width), springs.riseDown[i], springs.grid.down[i]);
    }
    return springs;
}

// The springs of rays, and what they pull.
void addLinks(const Rays& rays, const std::vector<double>& height, double tolerance, std::vector<SpringLink>& links,
              std::vector<double>& pull)
{
    for (const std::vector<GrazingRay>& ofLight : rays) {
        for (const GrazingRay& ray : ofLight) {
            const double over = height[ray.first] - height[ray.second] - ray.rise;
            const double weight = kRayWeight * cauchy(over, tolerance * (kRayError + kRayErrorShare * ray.rise));
            links.push_back({ray.first, ray.second, weight});
            pull[ray.first] += weight * ray.rise;
            pull[ray.second] -= weight * ray.rise;
        }
    }
}

// Rays into shadows that nothing casts as yet, and those that touch their borders.
Rays unmet(Rays rays, const std::vector<double>& height)
{
    for (std::vector<GrazingRay>& ofLight : rays) {
        std::erase_if(ofLight, [&](const GrazingRay& ray) {
            return !ray.isEdge && height[ray.first] - height[ray.second] >= ray.rise;
        });
    }
    return rays;
}

// Near lights and cameras have places before the plane of the outline.
void standOnOutline(const LitGrid& grid, std::vector<double>& height)
{
    Image image(grid.normals.width, grid.normals.height, 1);
    std::transform(height.begin(), height.end(), image.values.begin(), [](double z) { return static_cast<float>(z); });
    const double plane = outlineHeight(grid.normals, image);
    for (double& z : height) {
        z -= plane;
    }
}

std::vector<double> startHeight(const LitGrid& grid, const Image& byNormals)
{
    std::vector<double> height(byNormals.values.begin(), byNormals.values.end());
    if (isPlaced(grid)) {
        standOnOutline(grid, height);
    }
    return height;
}

} // namespace

Image heightFromShadows(const LitGrid& grid, std::span<const size_t> by, int threads)
{
    const HeightSprings springs = heightSprings(grid.normals);
    Image result = heightFromNormals(grid.normals, {.threads = threads}).height;
    const bool placed = isPlaced(grid);
    std::vector<double> height = startHeight(grid, result);
    const std::vector<size_t> lit = evenly(by, kMostLitLights);
    Rays shadows;
    for (int round = 0; round < kSolves; ++round) {
        const double tolerance = 2 * round < kSolves ? kWide : 1;
        const HeightSprings now = weakened(springs, height);
        std::vector<double> pull = pullOf(now);
        std::vector<SpringLink> links;
        if (placed || round == 0) { // the rays of distant lights stay the same
            shadows = traced(by, threads, [&](size_t light) { return shadowRays(grid, light, height); });
        }
        const Rays contradicted =
            traced(lit, threads, [&](size_t light) { return contradictedRays(grid, light, height); });
        addLinks(unmet(shadows, height), height, tolerance, links, pull);
        addLinks(contradicted, height, tolerance, links, pull);
        SpringSolver solver(now.grid, std::move(links), threads);
        solver.solve(pull, height, kSolverTolerance, kMostIterations);
        if (placed) {
            standOnOutline(grid, height);
        }
    }
    std::transform(height.begin(), height.end(), result.values.begin(), [](double z) { return static_cast<float>(z); });
    return result;
}

} // namespace nacre
