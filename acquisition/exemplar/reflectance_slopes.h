#pragma once
#include <array>
#include <vector>

#include <Eigen/Core>
#include <glm/vec3.hpp>

#include "acquisition/exemplar/reflectance.h"

namespace nacre {

// The numbers that make a reflectance: T by its logarithm, or where gloss is additive, and may be negative, by
// asinh(T / unit); then u, then v, then w where there is one.
constexpr int kLobeUnknowns = kHalfBins * kDifferenceBins;
constexpr int kShadeUnknowns = kLobeUnknowns; // the first of u
constexpr int kSlantUnknowns = kShadeUnknowns + kShadeKnots;
constexpr int kCouplingUnknowns = kSlantUnknowns + kShadeKnots;

Eigen::VectorXd unknownsOf(const Reflectance& reflectance, float unit);

// A reflectance by its unknowns, with what it takes to differentiate what it shows.
struct SlopedReflectance {
    Reflectance reflectance;
    std::vector<float> lobeSlopes; // of T by its unknown
};

// `like` says what the unknowns do not: the form, b, and whether there is a w.
SlopedReflectance reflectanceOf(const Eigen::VectorXd& unknowns, float unit, const Reflectance& like);

// A pixel by its normal and its albedo over its own bright level.
struct PixelGuess {
    size_t pixel = 0;
    glm::vec3 normal{0, 0, 1};
    float logScale = 0;
};

// Two directions across a normal.
struct NormalBasis {
    glm::vec3 across{0}, along{0};
};
NormalBasis basisOf(const glm::vec3& normal);

// The root of what a pixel shows of a light, over its bright level, and its derivatives: by steps of the normal across
// and along its basis, by logScale, and by the few unknowns that it depends on. Where all pixels have one albedo,
// logScale is nothing that a pixel may choose, and its derivative 0.
struct RootSlopes {
    float root = 0;
    std::array<float, 3> byPixel{};
    std::array<int, 16> unknowns{};
    std::array<float, 16> byUnknown{};
    int count = 0; // of the unknowns
};
RootSlopes rootSlopes(const SlopedReflectance& sloped, const PixelGuess& guess, const NormalBasis& basis, float bright,
                      const LightPlace& light);

} // namespace nacre
