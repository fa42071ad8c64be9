#include "acquisition/checks/light_places.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "acquisition/checks/matte_scatter.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kDistanceSteps = 5;   // third octaves nearer and further than the start
constexpr int kDepthSteps = 6;      // in front and behind, of
constexpr double kDepthStep = 0.05; // widths of the object
constexpr int kSurfaceSteps = 4;    // each leaves a third of the last one's error
constexpr int kLensSteps = 8;       // but by a lens alone more: a surface half found shows a distance that is not there
constexpr size_t kPlacingTriples = 100; // of lights: medians over pixels do not need each pixel's best one

// A sample whose pixels stand for squares of a picture, as a picture of such squares.
struct SampleGrid {
    Observations seen;
    glm::ivec2 size{0};
    int spacing = 1;
};

SampleGrid gridOf(Observations seen, const glm::ivec2& size)
{
    SampleGrid grid;
    grid.spacing = seen.spacing;
    grid.size = (size + seen.spacing - 1) / seen.spacing;
    for (uint32_t& pixel : seen.pixels) {
        const uint32_t x = pixel % static_cast<uint32_t>(size.x), y = pixel / static_cast<uint32_t>(size.x),
                       spacing = static_cast<uint32_t>(grid.spacing);
        pixel = y / spacing * static_cast<uint32_t>(grid.size.x) + x / spacing;
    }
    seen.width = grid.size.x;
    seen.spacing = 1;
    grid.seen = std::move(seen);
    return grid;
}

NearField rescaled(NearField near, double factor)
{
    for (glm::vec3& place : near.lights) {
        place *= static_cast<float>(factor);
    }
    near.depth *= factor;
    near.cameraDistance *= factor;
    near.origin *= factor;
    near.axis *= factor;
    return near;
}

struct PlaceTrial {
    NearField near; // in squares of the grid
    SurfaceGuess guess;
    double scatter = 0;
};

struct PlaceBench {
    const SampleGrid& grid;
    const std::vector<Light>& lights;
    NormalEstimator consensus;
    MatteChoice matte;
    int threads;
};

void explainSurface(const PlaceBench& bench, PlaceTrial& trial)
{
    const Observations& seen = bench.grid.seen;
    const bool isLens = std::isfinite(trial.near.cameraDistance) && trial.near.lights.empty();
    const int steps = isLens ? kLensSteps : kSurfaceSteps;
    for (int step = 0; step < steps; ++step) {
        const LocalLights local(bench.lights, trial.near, trial.guess.height, bench.grid.size.x);
        const Intensities distant =
            intensitiesOf(asIfDistant(seen, local, localNormals(seen, local, trial.guess.normals), 1), bench.lights);
        const NormalBlock fit = bench.consensus(distant);
        trial.scatter = matteScatter(distant, fit, bench.lights, bench.matte);
        NormalMap map(bench.grid.size.x, bench.grid.size.y);
        for (size_t p = 0; p < seen.pixels.size(); ++p) {
            map.normals[seen.pixels[p]] = local.toCamera(seen.pixels[p], fit.pixels[p].normal);
            map.confidence[seen.pixels[p]] = fit.pixels[p].confidence;
        }
        map = nextGuess(trial.guess.normals, std::move(map), trial.near);
        Image height = heightBefore(map, trial.near, 1);
        trial.guess = {std::move(map), std::move(height)};
    }
}

PlaceTrial bestTrial(const PlaceBench& bench, std::vector<PlaceTrial> trials)
{
    parallelFor(trials.size(), 1, bench.threads, [&](size_t first, size_t last) {
        for (size_t k = first; k < last; ++k) {
            explainSurface(bench, trials[k]);
        }
    });
    return *std::min_element(trials.begin(), trials.end(),
                             [](const PlaceTrial& a, const PlaceTrial& b) { return a.scatter < b.scatter; });
}

std::vector<PlaceTrial> atDistances(const NearField& near)
{
    std::vector<PlaceTrial> trials;
    for (int k = -kDistanceSteps; k <= kDistanceSteps; ++k) {
        NearField& tried = trials.emplace_back(PlaceTrial{near, {}, 0}).near;
        const float scale = std::exp2(static_cast<float>(k) / 3);
        tried.depth *= scale;
        for (glm::vec3& place : tried.lights) {
            place *= scale;
        }
    }
    return trials;
}

std::vector<PlaceTrial> atDepths(const NearField& near, double width)
{
    std::vector<PlaceTrial> trials;
    for (int k = -kDepthSteps; k <= kDepthSteps; ++k) {
        NearField& tried = trials.emplace_back(PlaceTrial{near, {}, 0}).near;
        const double step = k * kDepthStep * width;
        tried.depth += step;
        for (glm::vec3& place : tried.lights) {
            place.z += static_cast<float>(step);
        }
    }
    return trials;
}

SurfaceGuess spread(const SurfaceGuess& coarse, int spacing, const glm::ivec2& size)
{
    SurfaceGuess fine{NormalMap(size.x, size.y), Image(size.x, size.y, 1)};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const size_t from = coarse.normals.index(x / spacing, y / spacing), to = fine.normals.index(x, y);
            fine.normals.normals[to] = coarse.normals.normals[from];
            fine.normals.confidence[to] = coarse.normals.confidence[from];
            fine.height.values[to] = coarse.height.values[from] * static_cast<float>(spacing);
        }
    }
    return fine;
}

} // namespace

PlacedLights placeLights(const Observations& seen, const std::vector<Light>& lights, const NearField& near,
                         PlaceSearch search, const glm::ivec2& size, const NormalOptions& options)
{
    const SampleGrid grid = gridOf(seen, size);
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kPlacingTriples);
    quick.threads = 1; // places are tried beside each other
    NormalEstimator consensus = makeConsensusEstimator(lights, quick);
    const Intensities asSeen = intensitiesOf(grid.seen, lights);
    MatteChoice matte = matteObservations(asSeen, consensus(asSeen), lights);
    const PlaceBench bench{grid, lights, std::move(consensus), std::move(matte), options.threads};
    const double width = extentOf(grid.seen.pixels, grid.size.x).width;
    PlaceTrial best{rescaled(near, 1.0 / grid.spacing), {}, 0};
    best = bestTrial(bench, near.lights.empty() ? std::vector<PlaceTrial>{best} : atDepths(best.near, width));
    if (search == PlaceSearch::distance) { // along the valley that nearer and deeper places share
        best = bestTrial(bench, atDistances(best.near));
        best = bestTrial(bench, atDepths(best.near, width));
    }
    return {rescaled(best.near, grid.spacing), spread(best.guess, grid.spacing, size)};
}

} // namespace nacre
