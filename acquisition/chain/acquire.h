#pragma once
#include "acquisition/brdf/interpolation_choice.h"
#include "acquisition/brdf/model_ladder.h"
#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/capture_preparation.h"
#include "acquisition/chain/cast_shadow_report.h"
#include "acquisition/chain/material_samples.h"
#include "acquisition/residual/residual_estimate.h"
#include "acquisition/segmentation/segmentation.h"
#include "engine/surface/surface.h"

namespace nacre {

// How a material's table came about.
struct MaterialFit {
    InterpolationChoice interpolation; // judged where the choice was automatic
    ModelLadder ladder;                // empty where the full table was asked for
};

struct Acquisition {
    Surface surface;
    NormalEstimate estimate; // its normal map has moved into the surface
    Segmentation segmentation;
    SampleCounts samples;          // of all materials' inner pixels
    std::vector<MaterialFit> fits; // one a material
    CastShadowReport shadows;
    ResidualReport residual;
};

// Normals, and on the way samples of the BRDF with first albedo factors; then samples anew, which tables of the first
// ones judge: the blocks are walked twice.
struct NormalsAndSamples {
    NormalEstimate estimate;
    MaterialSamples gathered;
    ChosenMethod chosen; // by which normals were estimated
};
NormalsAndSamples estimateAndSample(PreparedCapture& prepared, const Capture& capture, const Segmentation& segmentation,
                                    const AcquireOptions& options, StageClock& clock, const Progress& progress);

// Photographs -> lights -> normals -> materials -> samples -> BRDF tables -> albedo factors -> cast shadows ->
// residual layer: the whole chain. A capture that fits into options.byteBudget is read once, a larger one once more for
// each of its later stages.
Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
