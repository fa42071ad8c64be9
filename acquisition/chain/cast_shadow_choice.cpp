#include "acquisition/chain/cast_shadow_choice.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "acquisition/capture/observations.h"
#include "acquisition/cast_shadows/full_height.h"
#include "acquisition/cast_shadows/lit_grid.h"
#include "acquisition/cast_shadows/shadow_height.h"
#include "acquisition/chain/self_lit_choice.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/surface/object_places.h"

namespace nacre {

namespace {

constexpr double kMostStates = 1 << 23; // of the grid: pixels times lights; a second of work for each of three heights
constexpr double kLeastCast = 1e-3;     // share of observations: fewer are errors of the normals
constexpr size_t kParts = 3;            // of the lights, each of which one height has not seen
constexpr size_t kFirstParts = 2;       // of them; where these say nothing for shadows, the rest is not asked
constexpr size_t kStatesAtOnce = 256;
constexpr int kBallSize = 64; // states need no more

struct ThinnedGrid {
    LitGrid grid;
    Thinning thinning;
};

int spacingFor(size_t pixels, size_t lights)
{
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pixels * lights) / kMostStates))));
}

// Of the shaded pixels' bounding box.
ThinnedGrid emptyGrid(const Surface& surface, size_t pixels)
{
    const NormalMap& normals = surface.normals;
    glm::ivec2 first(normals.width, normals.height), end(0);
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            if (isShaded(surface, normals.index(x, y))) {
                first = glm::min(first, glm::ivec2(x, y));
                end = glm::max(end, glm::ivec2(x + 1, y + 1));
            }
        }
    }
    ThinnedGrid thinned;
    const int spacing = spacingFor(pixels, surface.lights.size());
    thinned.thinning = {spacing, first};
    const glm::ivec2 size = (end - first + spacing - 1) / spacing;
    LitGrid& grid = thinned.grid;
    grid.lights = lightDirections(surface);
    grid.normals = NormalMap(size.x, size.y);
    grid.states.assign(grid.normals.normals.size() * grid.lights.size(), LightState::unknown);
    return thinned;
}

// Radiance over irradiance in grey; of a clipped value what is predicted.
float greySeen(const Observations& block, size_t place, size_t light, const Light& by, float predicted)
{
    return block.saturatedOf(place)[light] != 0 ? predicted : greyOf(block.radianceOf(place)[light] / by.irradiance);
}

void addBlock(const Surface& surface, const LightBalls& balls, const Observations& block, int threads,
              ThinnedGrid& thinned)
{
    LitGrid& grid = thinned.grid;
    const size_t lights = grid.lights.size();
    const Thinning& thinning = thinned.thinning;
    parallelFor(block.pixels.size(), kStatesAtOnce, threads, [&](size_t first, size_t last) {
        std::vector<float> predicted(3 * lights);
        for (size_t p = first; p < last; ++p) {
            const uint32_t pixel = block.pixels[p];
            if (!isShaded(surface, pixel)) {
                continue;
            }
            const glm::ivec2 place(static_cast<int>(pixel) % block.width, static_cast<int>(pixel) / block.width),
                at = (place - thinning.origin) / thinning.spacing;
            if (thinning.middleOf(at.x, at.y) != place) {
                continue;
            }
            const glm::vec3& normal = surface.normals.normals[pixel];
            const size_t node = grid.normals.index(at.x, at.y);
            grid.normals.normals[node] = normal;
            grid.normals.confidence[node] = surface.normals.confidence[pixel];
            balls.predict(pixel, predicted);
            for (size_t i = 0; i < lights; ++i) {
                const float grey = greyOf({predicted[i], predicted[lights + i], predicted[2 * lights + i]});
                grid.state(node, i) = lightStateOf(glm::dot(normal, grid.lights[i]),
                                                   greySeen(block, p, i, surface.lights[i].light, grey), grey);
            }
        }
    });
}

ThinnedGrid litGridOf(const Measurement& measurement, ObservationBlocks& blocks, size_t pixels)
{
    const Surface& surface = measurement.surface;
    const int threads = measurement.prepared.threads;
    const LightBalls balls(surface, kBallSize, threads);
    ThinnedGrid thinned = emptyGrid(surface, pixels);
    while (const Observations* block = blocks.next()) {
        forEachDirect(measurement.prepared, measurement.method, *block, threads,
                      [&](const Observations& direct) { addBlock(surface, balls, direct, threads, thinned); });
    }
    return thinned;
}

double castShareOf(const LitGrid& grid)
{
    const auto count = [&](LightState state) {
        return static_cast<double>(std::count(grid.states.begin(), grid.states.end(), state));
    };
    const double cast = count(LightState::cast), facing = cast + count(LightState::lit);
    return facing > 0 ? cast / facing : 0.0;
}

// By one thread: several are found side by side.
Image heightBy(const NormalMap& normals, const ThinnedGrid& thinned, std::span<const size_t> by)
{
    return fullHeight(normals, thinned.grid.normals, heightFromShadows(thinned.grid, by, 1), thinned.thinning, 1);
}

// Rows of the pixels' predictions where the horizon hides lights.
void hideLights(const HorizonMap& horizon, std::span<const uint32_t> pixels, std::span<const glm::vec3> lights,
                Eigen::MatrixXf& predicted)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec4 lookup = horizonLookup(lights[i], horizon.azimuths);
        for (size_t p = 0; p < pixels.size(); ++p) {
            predicted.block<3, 1>(static_cast<Eigen::Index>(3 * p), static_cast<Eigen::Index>(i)) *=
                visibilityOf(horizon, lookup, pixels[p]);
        }
    }
}

// The lights of all folds but those of one part: a fold is of one part. All lights where there is no such part.
std::vector<size_t> lightsWithout(const UnseenRows& unseen, size_t part)
{
    std::vector<size_t> lights;
    for (size_t fold = 0; fold < unseen.folds.size(); ++fold) {
        if (fold % kParts != part) {
            lights.insert(lights.end(), unseen.folds[fold].begin(), unseen.folds[fold].end());
        }
    }
    std::sort(lights.begin(), lights.end());
    return lights;
}

double predictedPsnr(const Surface& surface, const LeftOut& leftOut, ResidualChoice layer)
{
    const std::vector<glm::vec3> directions = lightDirections(surface);
    const ResidualFit fit =
        chooseResidualFit(leftOut.rows, leftOut.unseen, directions, judgeOf(surface, leftOut.rows), layer);
    return layer != ResidualChoice::none && fit.isKept ? fit.layerPsnr : fit.brdfPsnr;
}

std::string whyNoShadows(const Measurement& measurement, const LeftOut& leftOut)
{
    if (!leftOut.whyNot.empty() || leftOut.shadedPixels == 0) {
        return leftOut.whyNot;
    }
    return measurement.prepared.nearField ? "lights are near or the camera has a lens" : "";
}

} // namespace

CastShadows findCastShadows(const Measurement& measurement, ObservationBlocks& blocks, LeftOut leftOut,
                            ResidualChoice layer)
{
    const Surface& surface = measurement.surface;
    const int threads = measurement.prepared.threads;
    CastShadows shadows;
    CastShadowReport& report = shadows.report;
    shadows.leftOut = std::move(leftOut);
    report.whyNot = whyNoShadows(measurement, shadows.leftOut);
    if (!report.whyNot.empty() || shadows.leftOut.shadedPixels == 0) {
        return shadows;
    }
    const ThinnedGrid thinned = litGridOf(measurement, blocks, shadows.leftOut.shadedPixels);
    report.castShare = castShareOf(thinned.grid);
    if (report.castShare < kLeastCast) {
        report.whyNot = "next to nothing lies in a shadow that something else casts";
        return shadows;
    }
    const std::vector<size_t> all = lightsWithout(shadows.leftOut.unseen, kParts);
    LeftOut hidden = shadows.leftOut;
    const auto hideUnseen = [&](size_t part) {
        const Image height = heightBy(surface.normals, thinned, lightsWithout(hidden.unseen, part));
        const HorizonMap horizon = horizonMap(surface.normals, height, kHorizonAzimuths, 1);
        for (size_t fold = part; fold < hidden.unseen.folds.size(); fold += kParts) {
            hideLights(horizon, hidden.rows.pixels, thinned.grid.lights, hidden.unseen.predicted[fold]);
        }
    };
    report.psnr = predictedPsnr(surface, shadows.leftOut, layer);
    parallelFor(kFirstParts, 1, threads, [&](size_t part, size_t) { hideUnseen(part); });
    report.shadowedPsnr = predictedPsnr(surface, hidden, layer);
    if (report.shadowedPsnr <= report.psnr) {
        return shadows;
    }
    Image whole;
    parallelFor(kParts + 1 - kFirstParts, 1, threads, [&](size_t i, size_t) {
        const size_t part = kFirstParts + i;
        part == kParts ? void(whole = heightBy(surface.normals, thinned, all)) : hideUnseen(part);
    });
    report.shadowedPsnr = predictedPsnr(surface, hidden, layer);
    report.areKept = report.shadowedPsnr > report.psnr + kShadowMargin;
    if (report.areKept) {
        shadows.horizon = horizonMap(surface.normals, whole, kHorizonAzimuths, threads);
        hideLights(shadows.horizon, hidden.rows.pixels, thinned.grid.lights, hidden.rows.predicted);
        shadows.height = std::move(whole);
        shadows.leftOut = std::move(hidden);
    }
    return shadows;
}

} // namespace nacre
