#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/files/image.h"

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

// A reflectance transformation image: what a viewer shows under a light is, per pixel and channel, the sum of the
// terms times their weights: sRGB code values, 1 = full scale.
struct RtiPicture {
    RtiBasis basis = RtiBasis::ptm;
    std::vector<Image> terms; // rtiTermCount(basis), 3 channels each

    int width() const { return terms.at(0).width; }
    int height() const { return terms.at(0).height; }
};

// Code values in [0,1], rounded to n/255.
Image relit(const RtiPicture& picture, const glm::vec3& light, int threads = 0);

// `count` directions evenly over the disc of (x, y), down to kLowestRtiLight: a spiral of golden angles (Vogel, A
// better way to construct the sunflower head, 1979). Even on the disc is n.l-weighted on the hemisphere of a piece that
// faces the camera, and it is on the disc that the biquadratic is a polynomial.
std::vector<glm::vec3> rtiLights(int count);

// Others, between those, to judge a fit by.
std::vector<glm::vec3> rtiCheckLights();

// What is fitted: code values in [0,1] under one light, 3 channels.
using PictureUnderLight = std::function<Image(const glm::vec3& light)>;

// Per pixel and channel the least-squares fit over the lights, in each of the bases. Each light is asked for once.
std::vector<RtiPicture> fitRti(const PictureUnderLight& pictureUnder, std::span<const RtiBasis> bases,
                               std::span<const glm::vec3> lights, int threads = 0);

// PSNR [dB] of 8-bit codes, squared errors pooled over lights, pixels of the mask and channels.
double rtiPsnr(const RtiPicture& picture, const PictureUnderLight& pictureUnder, std::span<const glm::vec3> lights,
               std::span<const uint8_t> mask, int threads = 0);

} // namespace nacre
