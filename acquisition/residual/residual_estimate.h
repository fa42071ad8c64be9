#pragma once
#include <functional>

#include "acquisition/capture/observations.h"
#include "acquisition/residual/residual_report.h"
#include "engine/surface/surface.h"

namespace nacre {

// Calls its argument with every block of the capture, in order.
using EachBlock = std::function<void(const std::function<void(const Observations&)>&)>;

// The layer of a finished surface, whose lights are the blocks'; empty where it is not kept. Walks the capture twice.
// Throws Error (data) where a layer is insisted on and the lights are fewer than six or lie on a line.
ResidualLayer estimateResidual(const Surface& surface, const ResidualOptions& options, const EachBlock& eachBlock,
                               ResidualReport& report);

} // namespace nacre
