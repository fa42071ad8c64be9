#pragma once
#include "acquisition/chain/cast_shadow_report.h"
#include "acquisition/chain/remeasured_sample.h"
#include "acquisition/residual/left_out.h"

namespace nacre {

struct CastShadows {
    CastShadowReport report;
    Image height; // as Surface::height, and the horizon of it; empty where shadows are not kept
    HorizonMap horizon;
    LeftOut leftOut; // as given; with the shadows taken into account where they are kept
};

// The height that fits the normals of a finished surface and the shadows in its photographs, where predictions gain by
// it. Of a light left out heights are asked that have not seen a third of the lights, this one among them. `layer`:
// whether a residual layer may follow, which is judged along. Walks the measurement's blocks once.
CastShadows findCastShadows(const Measurement& measurement, ObservationBlocks& blocks, LeftOut leftOut,
                            ResidualChoice layer);

} // namespace nacre
