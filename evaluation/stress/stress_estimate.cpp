#include "evaluation/stress/stress_estimate.h"

#include "acquisition/checks/height_consistency.h"
#include "acquisition/lights/lights.h"
#include "acquisition/lights/sphere_agreement.h"
#include "acquisition/normals/light_triples.h"
#include "acquisition/normals/pixel_sample.h"

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
    StressPhotographs photographs{
        {evenSample(object.seen), object.photographs, object.irradiancesKnown, object.lights, object.width}, {}};
    photographs.prepared = preparePhotographs(photographs.sample, options);
    return photographs;
}

StressEstimate estimateNormals(const PhotographedObject& object, const StressPhotographs& photographs,
                               const AcquireOptions& options)
{
    StressEstimate estimate;
    estimate.prepared = photographs.prepared;
    completeNormals(photographs.sample, options, estimate.prepared);
    estimate.seen = selectLights(object.seen, estimate.prepared.agreeing);
    estimate.block = estimateBlock(estimate.prepared.estimator, estimate.seen, estimate.prepared.lights);
    if (const auto warning = sphereWarning(directionsOf(object.lights), object.shadingDirections)) {
        estimate.warnings.push_back("warning: " + *warning);
    }
    for (const std::string& warning : heightWarnings(mapOf(object, estimate.block))) {
        estimate.warnings.push_back(warning);
    }
    for (const std::string& remark : estimate.prepared.report.remarks) {
        if (remark.starts_with("warning:")) {
            estimate.warnings.push_back(remark);
        }
    }
    return estimate;
}

} // namespace nacre
