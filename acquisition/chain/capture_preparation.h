#pragma once
#include <utility>

#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// Reads and calibrates a capture and reconciles its photographs; with the sample of them as it was seen.
std::pair<PreparedCapture, Observations> reconcileCapture(const Capture& capture, const AcquireOptions& options,
                                                          StageClock& clock, const Progress& progress);

// Reads, calibrates and checks a capture, and finds out where its lights stand.
PreparedCapture prepareCapture(const Capture& capture, const AcquireOptions& options, StageClock& clock,
                               const Progress& progress);

// Photographs -> lights -> normals, of an object of one material.
NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
