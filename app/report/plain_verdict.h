#pragma once
#include <string>

#include "acquisition/chain/normal_estimation.h"

namespace nacre {

// One sentence on how far normals are to be trusted, for those who know the object better than the method: "Good: ...",
// or "Doubtful: ..." with a reason for each warning.
std::string plainVerdict(const NormalEstimate& estimate);

} // namespace nacre
