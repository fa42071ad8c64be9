#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

// Functions of the light's direction: a pixel of a reflectance transformation image is a weighted sum of them. ptm is
// the biquadratic of Malzbender, Gelb and Wolters, Polynomial Texture Maps, SIGGRAPH 2001; hsh the hemispherical
// harmonics to the second order of Gautron et al., A Novel Hemispherical Basis for Accurate and Efficient Rendering,
// 2004.
enum class RtiBasis { ptm, hsh };

// "ptm" or "hsh", as info.json has it.
std::string rtiBasisName(RtiBasis basis);

size_t rtiTermCount(RtiBasis basis); // 6 or 9

// Lights lower than this [radians above the picture's plane] are taken to stand there: hsh has no value on the horizon.
inline constexpr double kLowestRtiLight = 0.15;

// The functions' values for a unit direction towards the light, x right, y up, z towards the camera. In the order of
// the planes of `relight`: ptm 1, x, y, x^2, xy, y^2; hsh by degree, then order.
std::vector<double> rtiWeights(RtiBasis basis, const glm::vec3& light);

} // namespace nacre
