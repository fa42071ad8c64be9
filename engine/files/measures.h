#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/files/image.h"

namespace nacre {

// The q-quantile (0..1) by linear interpolation between order statistics. values must not be empty; they are reordered.
float quantile(std::vector<float>& values, double q);

// The radiance that counts as 1 where pictures are judged or exposed: the 99th percentile of all that the mask shows,
// every channel a value of its own; 1 where that is not above 0. values are reordered.
float peakOf(std::vector<float>& values);
// Of at most so many of them, evenly.
float peakOf(std::span<const glm::vec3> radiance, size_t mostValues = ~size_t{0});
float peakOf(const Image& radiance, std::span<const uint8_t> mask);

// Stops that put a peak at 0.9 of display white, to 1/1024 of a stop: quarters added and taken away leave the same
// float.
float exposureOfPeak(double peak);

// Grey of linear Rec. 601 weights, as DiLiGenT's published figures use it: what normals, verdicts and grey PSNR see.
inline float greyOf(const glm::vec3& rgb)
{
    return 0.2989f * rgb.x + 0.5870f * rgb.y + 0.1140f * rgb.z;
}

// Where a camera's own channels count alike: calibration spheres, an offset of the sensor.
inline float channelMean(const glm::vec3& rgb)
{
    return (rgb.x + rgb.y + rgb.z) / 3;
}

// PSNR [dB] of radiance: over mask pixels (mask[i] != 0), values divided by the peak of all the capture's mask values,
// clipped to [0,1], peak 1, squared errors pooled over pixels and channels. +inf where equal.
double radiancePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask, double peak);

// PSNR [dB] of 8-bit pictures whose values are code values / 255; over the mask, peak 255.
double picturePsnr(const Image& a, const Image& b, std::span<const uint8_t> mask);

double degreesBetween(const glm::vec3& a, const glm::vec3& b);

// How far apart two pictures of 8-bit codes are (values n/255), over the mask, each pixel by its worst channel.
struct CodeDifference {
    int largest = 0;   // codes
    size_t beyond = 0; // pixels off by more than `tolerance` codes
    size_t pixels = 0; // in the mask
    double share() const { return pixels == 0 ? 0.0 : static_cast<double>(beyond) / static_cast<double>(pixels); }
};

CodeDifference codeDifference(const Image& a, const Image& b, std::span<const uint8_t> mask, int tolerance);
CodeDifference codeDifference(const Image& a, const Image& b, int tolerance);

// Mean structural similarity of pictures whose values are codes in [0,1]: Wang, Bovik, Sheikh, Simoncelli, Image
// Quality Assessment: From Error Visibility to Structural Similarity, 2004, Eq. 13 with K1 = 0.01, K2 = 0.03, Gaussian
// windows of 11x11 pixels, sigma 1.5. It is the mean over the pixels' windows and over red, green and blue: luma alone
// would not see two colours exchanged. 1 where the pictures are equal, towards 0 and below where they have nothing in
// common. Windows at the border are cut off and their weights made to add up to 1 (the authors' code leaves them out).
double structuralSimilarity(const Image& a, const Image& b);

// Over the windows whose middle is in the mask (mask[i] != 0); they see their neighbours outside too. NaN where the
// mask is empty.
double structuralSimilarity(const Image& a, const Image& b, std::span<const uint8_t> mask);

} // namespace nacre
