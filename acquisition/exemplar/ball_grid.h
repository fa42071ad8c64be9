#pragma once
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/lights/light.h"

namespace nacre {

// Normals that face the camera, on a square of texels: Lambert's azimuthal equal-area projection of the hemisphere onto
// the disc that the square encloses, so that a texel is as wide at the rim as in the middle. Texel (0, 0) is top left.
constexpr int kBallSize = 64; // texels across: 2.5 degrees each; polishing does the rest
glm::vec2 ballTexelOf(const glm::vec3& normal, int size);
glm::vec3 normalOfBallTexel(const glm::vec2& texel, int size); // beyond the rim: that of the rim

// A reflectance that a fixed view sees depends on thetaH and thetaD (half-angle coordinates, Rusinkiewicz 1998). Bins
// of thetaH are spaced by its square root, fine where highlights are; those of thetaD evenly up to the largest.
constexpr int kHalfBins = 48;
constexpr int kDifferenceBins = 8;

// Bin coordinates: bin b reaches from b to b + 1.
float halfBinOf(float cosThetaH);
float differenceBinOf(float cosThetaD, float largestThetaD);
// The thetaH, in radians, in the middle of a bin.
float thetaHOfBin(int bin);

// What the ball's texels and the lights are to each other, whatever the reflectance. Rows are texels, one a column of
// lights padded to a multiple of eight; a few texels beyond the rim repeat it, so that interpolation has four
// neighbours everywhere.
struct BallGrid {
    int size = 0; // texels across
    size_t lightCount = 0;
    size_t stride = 0;
    float largestThetaD = 0;        // radians
    std::vector<int> rows;          // size x size; -1 where there is none
    std::vector<glm::vec3> normals; // per row
    std::vector<float> cosines;     // [row * stride + light] max(0, n.l)
    std::vector<float> halfBins;    // [row * stride + light], places between the middles of the bins
    std::vector<glm::vec3> directions;
    std::vector<glm::vec3> halves; // per light, halfway to the camera

    // The row of the texel that is nearest; -1 where there is none.
    int rowAt(const glm::vec2& texel) const;
};

BallGrid makeBallGrid(int size, const std::vector<Light>& lights, int threads);

// A place between two of so many knots, 0, 1 and so on; where it lies beyond them, that of the last.
struct Between {
    int knot = 0;
    float share = 0; // of the next one
    bool isInside = false;
};
Between between(float place, int knots);

// A light as the bins of thetaD see it: between the middles of two.
struct LightPlace {
    glm::vec3 direction{0}, half{0};
    int difference = 0;  // bin of thetaD
    float nextShare = 0; // of the bin beyond
};
std::vector<LightPlace> lightPlaces(const BallGrid& grid);

} // namespace nacre
