#pragma once
#include <functional>
#include <string>
#include <vector>

#include "acquisition/brdf/bake.h"
#include "acquisition/brdf/brdf_samples.h"
#include "acquisition/capture/capture.h"
#include "acquisition/lights/lights.h"
#include "acquisition/normals/normals.h"
#include "engine/scene/surface.h"

namespace nacre {

struct AcquireOptions {
    CalibrationOptions calibration;
    NormalOptions normals;
    SampleOptions samples;
    RegressionOptions regression;
    BakeOptions bake;
    size_t byteBudget = ObservationReader::kDefaultByteBudget;
    // Photographs that disagree with the rest, and irradiances that nobody gave.
    bool correctIntensities = true;
    bool keepVerdicts = false; // of every observation, for pictures of them

    void setThreads(int threads);
};

// Called with the stage's name and its finished share in [0, 1].
using Progress = std::function<void(const std::string&, double)>;

struct StageTime {
    std::string stage;
    double seconds = 0;
};

// How the observations under one light were judged.
struct VerdictCounts {
    size_t used = 0, shadow = 0, highlight = 0, saturated = 0;
};

// Normals alone: the first half of the chain.
struct NormalEstimate {
    Rig rig;
    NormalMap normals;
    NormalReport report;
    size_t pixelsWithoutNormal = 0;      // of the mask
    std::vector<VerdictCounts> verdicts; // per light
    std::vector<uint32_t> pixels;        // of the mask, and
    std::vector<Verdict> everyVerdict;   // [pixel * lights + light]; both empty unless kept
    std::vector<StageTime> times;
};

struct Acquisition {
    Surface surface;
    NormalEstimate estimate; // its normal map has moved into the surface
    SampleCounts samples;
};

// Photographs -> lights -> normals.
NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress);

// Photographs -> lights -> normals -> samples -> BRDF table: the whole chain, each photograph read once.
Acquisition acquire(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
