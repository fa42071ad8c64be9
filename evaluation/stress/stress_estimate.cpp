#include "evaluation/stress/stress_estimate.h"

#include "acquisition/capture/observations.h"
#include "acquisition/checks/height_consistency.h"
#include "acquisition/lights/lights.h"
#include "acquisition/normals/light_triples.h"

namespace nacre {

namespace {

NormalMap mapOf(const PhotographedObject& object, const NormalBlock& block)
{
    NormalMap map(object.width, object.height);
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        map.normals[object.seen.pixels[p]] = block.pixels[p].normal;
        map.confidence[object.seen.pixels[p]] = block.pixels[p].confidence;
    }
    return map;
}

} // namespace

StressPhotographs preparedPhotographs(const PhotographedObject& object, const AcquireOptions& options)
{
    requireSpanningLights(object.lights, object.name);
    StressPhotographs photographs;
    photographs.reconciled = reconcilePhotographs(
        {evenSample(object.seen), object.photographs, object.irradiancesKnown, object.lights, object.width}, options);
    const CaptureSample& sample = photographs.reconciled.sample;
    photographs.checked = checkCapture(sample.seen, sample.width, sample.lights, options.normals);
    photographs.seen = selectLights(object.seen, photographs.reconciled.agreeing);
    return photographs;
}

StressEstimate estimateNormals(const PhotographedObject& object, const StressPhotographs& photographs,
                               const AcquireOptions& options)
{
    const CaptureSample& sample = photographs.reconciled.sample;
    const ChosenMethod chosen = chooseMethod(sample, photographs.checked, options.normals);
    StressEstimate estimate{estimateBlock(chosen.estimators.front(), photographs.seen, sample.lights), {}};
    if (const auto warning = sphereWarning(directionsOf(object.lights), object.shadingDirections)) {
        estimate.warnings.push_back({FindingCode::spheresDisagree, *warning});
    }
    append(estimate.warnings, heightWarnings(mapOf(object, estimate.block)));
    append(estimate.warnings, warningsOf(sample.lights));
    append(estimate.warnings, photographs.checked.findings);
    append(estimate.warnings, chosen.findings);
    std::erase_if(estimate.warnings, [](const Finding& finding) { return !isWarning(finding.code); });
    return estimate;
}

} // namespace nacre
