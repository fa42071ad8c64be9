#pragma once
#include "acquisition/capture/observation_blocks.h"
#include "acquisition/residual/residual_report.h"
#include "engine/surface/surface.h"

namespace nacre {

struct EstimatedResidual {
    ResidualLayer layer; // empty where it is not kept
    ResidualReport report;
};

// The layer of a finished surface, whose lights are the blocks'. Walks the blocks twice. Throws Error (data) where a
// layer is insisted on and the lights are fewer than six or lie on a line.
EstimatedResidual estimateResidual(const Surface& surface, const ResidualOptions& options, ObservationBlocks& blocks);

} // namespace nacre
