#pragma once
#include <span>

#include <glm/vec3.hpp>

namespace nacre {

// Linear Rec. 709 of a reflectance spectrum under D65 by the CIE 1931 2 degree observer, over 400 to 700 nm in steps of
// 10 nm; a perfect reflector (1 at all wavelengths) is exactly (1,1,1). Colours outside of the gamut have negative
// channels. `wavelengths` in nm ascend and reach from 400 or less to 700 or more; between them the spectrum is linear.
glm::vec3 rec709FromReflectance(std::span<const float> wavelengths, std::span<const float> spectrum);

} // namespace nacre
