#include "acquisition/chain/near_surface.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/checks/light_places.h"

namespace nacre {

namespace {

constexpr int kPasses = 2; // from a surface that is coarsely known
// Held-out errors have to fall by this share for an estimated distance to be taken.
constexpr double kLeastGain = 0.02;

void moveSample(const Observations& seen, PreparedCapture& prepared)
{
    const LocalLights local = prepared.localLights();
    prepared.reconciled.sample.seen =
        asIfDistant(seen, local, localNormals(seen, local, prepared.guess.normals), prepared.threads);
}

NormalMap wholeMap(const ChosenMethod& chosen, const Capture& capture, StageClock& clock, const Progress& progress,
                   PreparedCapture& prepared)
{
    NormalMap map(capture.width, capture.height);
    const Segmentation whole = oneMaterial(capture);
    BlockWalk walk(prepared.blocks, clock, progress, "surface");
    while (const Observations* block = walk.next()) {
        const NormalBlock normals = estimateNormals(prepared, chosen, whole, *block);
        for (size_t p = 0; p < block->pixels.size(); ++p) {
            map.normals[block->pixels[p]] = normals.pixels[p].confidence > 0 ? normals.pixels[p].normal : glm::vec3(0);
            map.confidence[block->pixels[p]] = normals.pixels[p].confidence;
        }
    }
    return map;
}

void approach(const Capture& capture, const Observations& seen, PlaceSearch search, const AcquireOptions& options,
              StageClock& clock, const Progress& progress, PreparedCapture& prepared)
{
    PlacedLights placed = placeLights(seen, prepared.rig.lights, *prepared.nearField, search,
                                      {capture.width, capture.height}, options.normals);
    prepared.nearField = std::move(placed.near);
    prepared.guess = std::move(placed.guess);
    for (int pass = 0; pass < kPasses; ++pass) {
        moveSample(seen, prepared);
        clock.enter("choosing");
        const ChosenMethod chosen = chooseMethod(prepared.reconciled.sample, prepared.checked, options.normals);
        NormalMap map = nextGuess(prepared.guess.normals, wholeMap(chosen, capture, clock, progress, prepared),
                                  *prepared.nearField);
        Image height = heightBefore(map, *prepared.nearField, prepared.threads);
        prepared.guess = {std::move(map), std::move(height)};
    }
    moveSample(seen, prepared);
    checkSample(options, prepared);
}

double widthsTo(const NearField& near, const Capture& capture)
{
    double sum = 0;
    for (const glm::vec3& place : near.lights) {
        sum += glm::length(place);
    }
    return sum / static_cast<double>(near.lights.size()) / extentOf(capture).width;
}

std::string placeText(const NearField& near, const Capture& capture)
{
    const std::string lens = std::isfinite(near.cameraDistance)
                                 ? fmt::format("the camera's view is {:g} degrees wide", *capture.fieldOfView)
                                 : "";
    const std::string lights =
        near.lights.empty() ? ""
                            : fmt::format("the lights stand at {:.2g} widths of the object", widthsTo(near, capture));
    return lights + (lights.empty() || lens.empty() ? "" : ", ") + lens;
}

} // namespace

void checkSample(const AcquireOptions& options, PreparedCapture& prepared)
{
    const CaptureSample& sample = prepared.reconciled.sample;
    prepared.checked = checkCapture(sample.seen, sample.lights, options.normals);
}

void approachSurface(const Capture& capture, const Observations& seen, const AcquireOptions& options, StageClock& clock,
                     const Progress& progress, PreparedCapture& prepared)
{
    if (prepared.nearField) {
        approach(capture, seen, PlaceSearch::depth, options, clock, progress, prepared);
        prepared.placed = {{FindingCode::lightsPlaced, placeText(*prepared.nearField, capture)}};
    }
    const std::optional<CaptureDefect> defect = prepared.checked.defect;
    if (!options.estimateDistance || capture.lightDistance || !capture.lightPlaces.empty() || !defect ||
        defect->kind != CaptureDefect::Kind::nearLights) {
        return;
    }
    const std::optional<NearField> farField = prepared.nearField;
    const SurfaceGuess farGuess = prepared.guess;
    const Observations farSample = prepared.reconciled.sample.seen;
    const CheckedSample farChecked = prepared.checked;
    const double farError = chooseMethod(prepared.reconciled.sample, prepared.checked, options.normals).heldOutError;
    prepared.nearField = withLightsAt(cameraOf(capture), prepared.rig.lights, defect->size * extentOf(capture).width);
    approach(capture, seen, PlaceSearch::distance, options, clock, progress, prepared);
    const double error = chooseMethod(prepared.reconciled.sample, prepared.checked, options.normals).heldOutError;
    if (!(error < (1 - kLeastGain) * farError)) {
        prepared.nearField = farField;
        prepared.guess = farGuess;
        prepared.reconciled.sample.seen = farSample;
        prepared.checked = farChecked;
        return;
    }
    prepared.placed = {{FindingCode::lightsPlaced,
                        fmt::format("{}, as the photographs tell (error on held-out lights {:.4f}, {:.4f} were they "
                                    "distant)",
                                    placeText(*prepared.nearField, capture), error, farError)}};
}

} // namespace nacre
