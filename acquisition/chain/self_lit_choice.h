#pragma once
#include <functional>

#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// The method for a prepared capture. Where its normals show that the object throws light on itself, this is taken out
// of the sample, and the object's reflectance found anew: what was made of both lights would make up for one that is
// gone. The method is chosen anew, too, unless it was exemplar.
ChosenMethod chooseMethod(const PreparedCapture& prepared, const Segmentation& materials,
                          const AcquireOptions& options);

// Visits the block as the lights alone light it: whole, or in parts of bounded size in the pixels' order where light
// has to be taken out, so that no second copy of a large block is held.
void forEachDirect(const PreparedCapture& prepared, const ChosenMethod& chosen, const Observations& block, int threads,
                   const std::function<void(const Observations& direct)>& visit);

} // namespace nacre
