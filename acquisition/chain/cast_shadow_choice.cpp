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
#include "acquisition/near_field/as_if_distant.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/scene/pixel_lights.h"
#include "engine/surface/object_places.h"
#include "shared/lens.h"

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
    NormalMap normals; // of all pixels, of which the grid has some
};

int spacingFor(size_t pixels, size_t lights)
{
    return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pixels * lights) / kMostStates))));
}

// A light as points of the grid see it, in pixels of the grid.
glm::vec4 lightOverGrid(const Surface& surface, const Light& light, const Thinning& thinning)
{
    const glm::vec4 place =
        pointInPicture(viewpointOf(surface, kFrontView),
                       isNear(light) ? glm::vec4(light.distance * light.direction, 1) : glm::vec4(light.direction, 0));
    if (place.w == 0) {
        return place;
    }
    const ObjectExtent extent = extentOf(surface.normals);
    const glm::dvec2 first(thinning.middleOf(0, 0));
    const glm::dvec2 middle = (extent.middle - 0.5 - first) / static_cast<double>(thinning.spacing);
    const auto scale = static_cast<float>(extent.width / thinning.spacing);
    return {scale * place.x + static_cast<float>(middle.x) * place.w,
            scale * place.y - static_cast<float>(middle.y) * place.w, scale * place.z, place.w};
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
    for (const CapturedLight& captured : surface.lights) {
        grid.lights.push_back(lightOverGrid(surface, captured.light, thinned.thinning));
    }
    if (surface.camera) {
        grid.cameraDistance = surface.camera->z * extentOf(surface.normals).width / spacing;
    }
    grid.normals = NormalMap(size.x, size.y);
    grid.states.assign(grid.normals.normals.size() * grid.lights.size(), LightState::unknown);
    return thinned;
}

// Radiance over irradiance in grey; of a clipped value what is predicted.
float greySeen(const Observations& block, size_t place, size_t light, const Light& by, float predicted)
{
    return block.saturatedOf(place)[light] != 0 ? predicted : greyOf(block.radianceOf(place)[light] / by.irradiance);
}

void addBlock(const Surface& surface, const LightBalls& balls, const PixelLights& met, const Observations& block,
              int threads, ThinnedGrid& thinned)
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
            grid.normals.normals[node] = thinned.normals.normals[pixel];
            grid.normals.confidence[node] = surface.normals.confidence[pixel];
            balls.predict(pixel, predicted);
            for (size_t i = 0; i < lights; ++i) {
                const float grey = greyOf({predicted[i], predicted[lights + i], predicted[2 * lights + i]});
                grid.state(node, i) = lightStateOf(glm::dot(normal, met.at(i, pixel).light.direction),
                                                   greySeen(block, p, i, surface.lights[i].light, grey), grey);
            }
        }
    });
}

ThinnedGrid litGridOf(const Measurement& measurement, ObservationBlocks& blocks, size_t pixels)
{
    const Surface& surface = measurement.surface;
    const int threads = measurement.prepared.threads;
    const LightBalls balls(surface, isPlaced(surface) ? 0 : kBallSize, threads);
    const PixelLights met(surface, unitLights(surface), kFrontView);
    ThinnedGrid thinned = emptyGrid(surface, pixels);
    thinned.normals = measurement.prepared.nearField ? withoutLens(surface.normals, *measurement.prepared.nearField)
                                                     : surface.normals;
    while (const Observations* block = blocks.next()) {
        forEachDirect(measurement.prepared, measurement.method, *block, threads,
                      [&](const Observations& direct) { addBlock(surface, balls, met, direct, threads, thinned); });
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

// What casts the surface's shadows: normals, the height that these lights show, its horizon; no material. By one
// thread: several are found side by side.
Surface casterBy(const Measurement& measurement, const ThinnedGrid& thinned, std::span<const size_t> by)
{
    const std::optional<NearField>& near = measurement.prepared.nearField;
    Surface caster;
    caster.normals = measurement.surface.normals;
    caster.camera = measurement.surface.camera;
    caster.height =
        fullHeight(thinned.normals, thinned.grid.normals, heightFromShadows(thinned.grid, by, 1), thinned.thinning, 1);
    if (near) {
        caster.height = heightOfIntegral(caster.normals, std::move(caster.height), *near);
    }
    caster.horizon = horizonMap(caster.normals, heightInPicture(caster), kHorizonAzimuths, 1);
    return caster;
}

// Rows of the pixels' predictions where the caster hides lights.
void hideLights(const Surface& caster, std::span<const uint32_t> pixels, const std::vector<Light>& lights,
                Eigen::MatrixXf& predicted)
{
    const PixelLights met(caster, lights, kFrontView);
    for (size_t p = 0; p < pixels.size(); ++p) {
        for (size_t i = 0; i < lights.size(); ++i) {
            predicted.block<3, 1>(static_cast<Eigen::Index>(3 * p), static_cast<Eigen::Index>(i)) *=
                met.at(i, pixels[p]).share;
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

} // namespace

CastShadows findCastShadows(const Measurement& measurement, ObservationBlocks& blocks, LeftOut leftOut,
                            ResidualChoice layer)
{
    const Surface& surface = measurement.surface;
    const int threads = measurement.prepared.threads;
    CastShadows shadows;
    CastShadowReport& report = shadows.report;
    shadows.leftOut = std::move(leftOut);
    report.whyNot = shadows.leftOut.whyNot;
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
    const std::vector<Light> lights = unitLights(surface);
    LeftOut hidden = shadows.leftOut;
    const auto hideUnseen = [&](size_t part) {
        const Surface caster = casterBy(measurement, thinned, lightsWithout(hidden.unseen, part));
        for (size_t fold = part; fold < hidden.unseen.folds.size(); fold += kParts) {
            hideLights(caster, hidden.rows.pixels, lights, hidden.unseen.predicted[fold]);
        }
    };
    report.psnr = predictedPsnr(surface, shadows.leftOut, layer);
    parallelFor(kFirstParts, 1, threads, [&](size_t part, size_t) { hideUnseen(part); });
    report.shadowedPsnr = predictedPsnr(surface, hidden, layer);
    if (report.shadowedPsnr <= report.psnr) {
        return shadows;
    }
    Surface whole;
    parallelFor(kParts + 1 - kFirstParts, 1, threads, [&](size_t i, size_t) {
        const size_t part = kFirstParts + i;
        part == kParts ? void(whole = casterBy(measurement, thinned, all)) : hideUnseen(part);
    });
    report.shadowedPsnr = predictedPsnr(surface, hidden, layer);
    report.areKept = report.shadowedPsnr > report.psnr + kShadowMargin;
    if (report.areKept) {
        hideLights(whole, hidden.rows.pixels, lights, hidden.rows.predicted);
        shadows.height = std::move(whole.height);
        shadows.horizon = std::move(whole.horizon);
        shadows.leftOut = std::move(hidden);
    }
    return shadows;
}

} // namespace nacre
