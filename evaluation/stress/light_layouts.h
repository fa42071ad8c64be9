#pragma once
#include <cstddef>
#include <vector>

#include "engine/lights/light.h"

namespace nacre {

// Where lights may stand, angles in degrees from the view; every irradiance is 1.

// All over the cap of directions up to `capDegrees` from `centre`, a unit direction.
std::vector<Light> spreadLights(size_t count, double capDegrees, const glm::vec3& centre = {0, 0, 1});

// On a circle about the view.
std::vector<Light> ringLights(size_t count, double polarDegrees);

// On an arc through the view, from 55 degrees on one side to 55 on the other; lights stand by turns so many degrees
// beside it, on either side. At 0 they lie in one plane with the object: rank 2.
std::vector<Light> arcLights(size_t count, double besideDegrees);

// On two arcs that cross in the view's direction at right angles.
std::vector<Light> crossedLights(size_t count);

} // namespace nacre
