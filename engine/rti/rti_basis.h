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

// Hemispherical harmonics up to an order, orthonormal over the hemisphere: (order + 1)^2 values, by degree l, in each
// cos(l phi) to cos(phi), the one that does not turn, sin(phi) to sin(l phi).
std::vector<double> hemisphericalHarmonics(const glm::vec3& light, int order);

// The functions' values for a unit direction towards the light, x right, y up, z towards the camera. In the order of
// the planes of `relight`: ptm 1, x, y, x^2, xy, y^2; hsh the harmonics to the second order.
std::vector<double> rtiWeights(RtiBasis basis, const glm::vec3& light);

} // namespace nacre
