#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "acquisition/capture/observations.h"
#include "engine/scene/pixel_lights.h"
#include "engine/surface/surface.h"

namespace nacre {

// The surface's captured lights, of irradiance 1.
std::vector<Light> unitLights(const Surface& surface);

// Whether its captured lights or its camera are near, so that no ball answers for them.
bool isPlaced(const Surface& surface);

// The surface's BRDFs under each of its captured lights, as reference balls (shaders/shared/ball.h): with the view from
// the front and distant lights, a ball answers all pixels of a material. They save time where pixels outnumber a ball's
// texels.
class LightBalls {
public:
    // `size`: texels across, at least 2; 0: no balls, each pixel asks its table, as a surface that is placed needs it.
    // The surface is referred to.
    LightBalls(const Surface& surface, int size, int threads);

    // Radiance over irradiance (at the object's middle) of a shaded pixel under all lights, those that the surface's
    // horizon hides included: [channel * lights + light].
    void predict(size_t pixel, std::span<float> predicted) const;

private:
    void askTable(size_t pixel, std::span<float> predicted) const;
    void askBall(size_t pixel, std::span<float> predicted) const;
    void addTexel(const float* texel, float share, const glm::vec3& albedo, std::span<float> predicted) const;

    const Surface& surface_;
    int size_;
    PixelLights met_;                           // the captured ones, of irradiance 1
    std::vector<std::vector<float>> materials_; // [texel * 3 * lights + channel * lights + light]
};

// Radiance over irradiance of some pixels: a row a pixel and channel, 3 * pixel + channel, a column a light.
struct ResidualRows {
    std::vector<uint32_t> pixels;
    Eigen::MatrixXf observed;  // of clipped values at least what is predicted: how much more there was is not known
    Eigen::MatrixXf predicted; // by the surface's BRDF
};

// The same pixels as surfaces predict them that have not seen some of the lights: each light is of one fold.
struct UnseenRows {
    std::vector<std::vector<size_t>> folds; // their lights
    std::vector<Eigen::MatrixXf> predicted; // one a fold: all lights, laid out as ResidualRows is
};

// Of the block's pixels at `places`, all of which have a normal and a material. `balls` are the surface's.
ResidualRows residualRows(const Observations& block, std::span<const size_t> places, const Surface& surface,
                          const LightBalls& balls);

// Rows of what the surface's BRDF says of some pixels.
Eigen::MatrixXf predictedRows(const LightBalls& balls, std::span<const uint32_t> pixels, size_t lights);

// [pixel, channel * lights + light]: what is left of each pixel where the BRDF is trusted so far.
Eigen::MatrixXf residualsOf(const ResidualRows& rows, float trust);

// Places of the block's pixels that have a normal and a material.
std::vector<size_t> shadedPlaces(const Observations& block, const Surface& surface);

} // namespace nacre
