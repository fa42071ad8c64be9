#pragma once
#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// The method for a prepared capture. Where its normals show that the object throws light on itself, this is taken out
// of the sample, and the method chosen anew: what was made of both lights would make up for one that is gone.
ChosenMethod chooseMethod(const PreparedCapture& prepared, const Segmentation& materials,
                          const AcquireOptions& options);

// The block as the lights alone light it: itself, or what is then in `direct`.
const Observations& directLight(const PreparedCapture& prepared, const ChosenMethod& chosen, const Observations& block,
                                int threads, Observations& direct);

} // namespace nacre
