#include "acquisition/brdf/cornell_samples.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace nacre {
namespace {

std::vector<float> wavelengthsEvery(float step)
{
    std::vector<float> wavelengths;
    for (float nm = 400; nm <= 700; nm += step) {
        wavelengths.push_back(nm);
    }
    return wavelengths;
}

TEST(CieColour, AFlatSpectrumIsNeutral)
{
    const std::vector<float> wavelengths = wavelengthsEvery(10);
    const glm::vec3 grey = rec709FromReflectance(wavelengths, std::vector<float>(wavelengths.size(), 0.18f));
    EXPECT_NEAR(grey.x, 0.18f, 1e-6f);
    EXPECT_NEAR(grey.y, 0.18f, 1e-6f);
    EXPECT_NEAR(grey.z, 0.18f, 1e-6f);
}

// Bands of wavelength have the colour that their name says, and bands that sum to white sum to (1,1,1).
TEST(CieColour, BandsHaveTheirColour)
{
    const std::vector<float> wavelengths = wavelengthsEvery(5);
    const auto band = [&](float from, float to) {
        std::vector<float> spectrum;
        for (float nm : wavelengths) {
            spectrum.push_back(nm >= from && nm < to ? 1.0f : 0.0f);
        }
        return rec709FromReflectance(wavelengths, spectrum);
    };
    const glm::vec3 blue = band(400, 490), green = band(490, 580), red = band(580, 701);
    EXPECT_TRUE(blue.z > 0.8f && blue.z > blue.x && blue.z > blue.y);
    EXPECT_TRUE(green.y > 0.6f && green.y > green.x && green.y > green.z);
    EXPECT_TRUE(red.x > 0.8f && red.x > red.y && red.x > red.z);
    const glm::vec3 sum = blue + green + red;
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c], 1, 1e-5f);
    }
    // Luminance of Rec. 709 in the sum of the parts: most of it is green.
    const auto luminance = [](const glm::vec3& f) { return 0.2126f * f.x + 0.7152f * f.y + 0.0722f * f.z; };
    EXPECT_GT(luminance(green), luminance(red));
    EXPECT_GT(luminance(red), 5 * luminance(blue));
}

TEST(CieColour, InterpolatesBetweenWavelengths)
{
    const auto ramp = [](const std::vector<float>& wavelengths) {
        std::vector<float> spectrum;
        for (float nm : wavelengths) {
            spectrum.push_back((nm - 400) / 300);
        }
        return rec709FromReflectance(wavelengths, spectrum);
    };
    const glm::vec3 fine = ramp(wavelengthsEvery(10)), coarse = ramp(wavelengthsEvery(100));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(fine[c], coarse[c], 1e-5f);
    }
}

} // namespace
} // namespace nacre
