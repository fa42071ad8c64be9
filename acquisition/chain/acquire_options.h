#pragma once
#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/brdf_samples.h"
#include "acquisition/brdf/model_ladder.h"
#include "acquisition/capture/observations.h"
#include "acquisition/lights/lights.h"
#include "acquisition/lights/well_spread_lights.h"
#include "acquisition/normals/normals.h"
#include "acquisition/residual/residual_estimate.h"
#include "acquisition/segmentation/segmentation.h"

namespace nacre {

struct AcquireOptions {
    CalibrationOptions calibration;
    LightChoice lights; // photographs that are not chosen are not read
    NormalOptions normals;
    SampleOptions samples;
    SegmentOptions segment;
    InterpolationOptions interpolation;
    BakeOptions bake;
    LadderOptions ladder; // nothing asked: the full table
    ResidualOptions residual;
    size_t byteBudget = ObservationReader::kDefaultByteBudget;
    // Photographs that disagree with the rest, and irradiances that nobody gave.
    bool correctIntensities = true;
    // A distance of the lights that nobody gave. Normals alone surely gain by it: normals that are bent like the
    // photographs relight about as well.
    bool estimateDistance = false;
    // Light that the object throws on itself, where auto and exemplar find any; the other methods are as published.
    bool removeSelfLight = true;
    bool castShadows = false;  // of the object on itself, in what the surface predicts, where it gains by them
    bool keepVerdicts = false; // of every observation, for pictures of them

    void setThreads(int threads)
    {
        calibration.threads = normals.threads = samples.threads = interpolation.threads = bake.threads =
            ladder.threads = residual.threads = threads;
    }
};

} // namespace nacre
