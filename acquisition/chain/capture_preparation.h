#pragma once
#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// Reads, calibrates and checks a capture, and finds out where its lights stand.
PreparedCapture prepareCapture(const Capture& capture, const AcquireOptions& options, StageClock& clock,
                               const Progress& progress);

// Photographs -> lights -> normals, of an object of one material.
NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
