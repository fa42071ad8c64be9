#pragma once
#include "acquisition/acquire_options.h"
#include "acquisition/brdf/interpolation_choice.h"
#include "acquisition/normal_estimation.h"
#include "engine/scene/surface.h"

namespace nacre {

struct Acquisition {
    Surface surface;
    NormalEstimate estimate; // its normal map has moved into the surface
    SampleCounts samples;
    ModelLadder ladder;                // empty where the full table was asked for
    InterpolationChoice interpolation; // what the table was made with; judged where the choice was automatic
};

// Photographs -> lights -> normals -> samples -> BRDF table -> albedo factors: the whole chain. A capture that fits
// into options.byteBudget is read once, a larger one once more for each of its later stages.
Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
