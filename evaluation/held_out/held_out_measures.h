#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/observations.h"
#include "acquisition/chain/acquire.h"
#include "engine/files/measures.h"
#include "engine/surface/surface.h"

namespace nacre {

// Radiance of the pixels of some observations, [pixel * photographs + photograph].
using Predictions = std::vector<glm::vec3>;

// What a surface shows under the lights of photographs that it was not made of.
Predictions predictBySurface(const Surface& surface, const Observations& heldOut, const std::vector<Light>& lights,
                             int threads);

// Both divided by the peak and clipped to [0, 1], a minus b.
float clippedError(float a, float b, double peak);
double decibels(double squaredError, size_t count);
// dB of radiance, colour, errors pooled over all photographs.
double pooledPsnr(const Predictions& predicted, const Observations& heldOut, double peak);

// One photograph of some observations, or of their predictions, as a picture; 0 beside the object.
Image pictureOf(const Observations& seen, std::span<const glm::vec3> radiance, size_t photograph, int width,
                int height);

// |predicted - photograph| / max(photograph, floor), every channel of every pixel in the mask for itself.
std::vector<float> relativeErrors(const Image& predicted, const Image& photograph, std::span<const uint8_t> mask,
                                  double floor);

// How well one photograph is predicted.
struct PhotographMeasures {
    std::string photograph;
    double psnr = 0; // dB of radiance
    double medianRelativeError = 0;
    double percentile95RelativeError = 0;
    double structuralSimilarity = 0; // of the 8-bit sRGB pictures
};

// Below this share of the capture's peak a relative error is told against it: noise of black is not a large error.
constexpr double kRelativeErrorFloor = 0.01;

// `peak`: the 99th percentile of all that the capture's mask shows.
PhotographMeasures measurePhotograph(const Image& predicted, const Image& photograph, std::span<const uint8_t> mask,
                                     double peak);

// Degrees between a capture's normals and true ones. `truth`: a file, or "sphere", the ball that fills the mask.
AngularError errorAgainstTruth(const Capture& capture, const NormalMap& normals, const std::filesystem::path& truth);

// Of a surface's models as they are kept in memory, coverage apart; components that materials share count once.
size_t modelBytes(const Surface& surface);

// Photographs that an acquisition is not given, and what predictions of them are measured against.
struct JudgingPhotographs {
    Observations seen;
    std::vector<Light> lights;
    double peak = 1; // radiance that counts as 1
};

// Indices of the photographs that a choice holds out.
std::vector<size_t> heldOutIndices(size_t photographs, const LightChoice& choice);

// dB of radiance of all of them together.
double psnrOf(const Surface& surface, const JudgingPhotographs& judging, int threads);

} // namespace nacre
