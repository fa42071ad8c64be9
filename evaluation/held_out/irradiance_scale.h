#pragma once
#include <vector>

#include "engine/lights/light.h"

namespace nacre {

// Irradiances that were estimated from two sets of photographs of the same lights differ by what no photograph tells: a
// factor of all, and one that grows from one side of the lights to the other, which tilted normals make up for. Brings
// `lights`, on the scale of `from`, to that of `to`, which are the same lights twice: log factors affine in the
// direction's x and y, of least squares.
void bringToScale(const std::vector<Light>& from, const std::vector<Light>& to, std::vector<Light>& lights);

// The same where irradiances were given, and corrected for single lights alone: by the median factor of each channel.
void bringToMedianScale(const std::vector<Light>& from, const std::vector<Light>& to, std::vector<Light>& lights);

} // namespace nacre
