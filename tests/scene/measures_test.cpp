#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/hash_random.h"
#include "engine/files/measures.h"
#include "engine/surface/normal_map.h"

namespace nacre {
namespace {

// Two pixels, one in the mask; errors of 0.1, 0.2 and 0 by hand: mean square 0.05/3, PSNR 17.78 dB.
TEST(Measures, PictureAndRadiancePsnrByHand)
{
    Image a(2, 1, 3), b(2, 1, 3);
    a.values = {0.5f, 0.5f, 0.5f, 0, 0, 0};
    b.values = {0.6f, 0.3f, 0.5f, 1, 1, 1};
    const std::vector<uint8_t> mask = {1, 0};
    const double byHand = 10 * std::log10(3 / 0.05);
    EXPECT_NEAR(picturePsnr(a, b, mask), byHand, 1e-5);
    // Twice the peak: errors halve, 6.02 dB more.
    EXPECT_NEAR(radiancePsnr(a, b, mask, 2), byHand + 20 * std::log10(2), 1e-5);
    EXPECT_EQ(picturePsnr(a, a, mask), std::numeric_limits<double>::infinity());
}

TEST(Measures, RadianceIsClippedAtThePeak)
{
    Image a(1, 1, 1), b(1, 1, 1);
    a.values = {3};
    b.values = {5};
    const std::vector<uint8_t> mask = {1};
    EXPECT_EQ(radiancePsnr(a, b, mask, 3), std::numeric_limits<double>::infinity());
    EXPECT_NEAR(radiancePsnr(a, b, mask, 10), -10 * std::log10(0.04), 1e-5);
}

TEST(Measures, QuantileInterpolates)
{
    std::vector<float> values = {4, 1, 3, 2};
    EXPECT_FLOAT_EQ(quantile(values, 0.5), 2.5f);
    EXPECT_FLOAT_EQ(quantile(values, 0), 1);
    EXPECT_FLOAT_EQ(quantile(values, 1), 4);
    EXPECT_FLOAT_EQ(quantile(values, 0.9), 3.7f);
}

// Few values are counted lane by lane, many are moved about: both are what sorting says, with ties and signs.
TEST(Measures, QuantileIsThatOfTheSortedValues)
{
    uint64_t seed = 1;
    for (const size_t count : {1, 2, 7, 8, 9, 96, 511, 512, 513, 2000}) {
        for (const uint64_t distinct : {uint64_t{3}, uint64_t{1000000}}) {
            std::vector<float> values;
            for (size_t i = 0; i < count; ++i) {
                const float value = static_cast<float>(nextRandom(seed) % distinct) / static_cast<float>(distinct);
                values.push_back(std::ldexp(value - 0.3f, static_cast<int>(nextRandom(seed) % 20) - 10));
            }
            std::vector<float> sorted = values;
            std::sort(sorted.begin(), sorted.end());
            for (const double q : {0.0, 0.1, 0.5, 0.9, 1.0}) {
                const double place = q * static_cast<double>(count - 1);
                const size_t low = static_cast<size_t>(place);
                const float next = sorted[std::min(low + 1, count - 1)];
                EXPECT_EQ(quantile(values, q),
                          sorted[low] + static_cast<float>(place - static_cast<double>(low)) * (next - sorted[low]))
                    << count << " values, q " << q;
            }
        }
    }
}

TEST(Measures, AngularErrorCountsMissingNormalsAsNinetyDegrees)
{
    NormalMap truth(4, 1), normals(4, 1);
    for (int i = 0; i < 3; ++i) {
        truth.normals[i] = {0, 0, 1};
        truth.confidence[i] = 1;
    }
    normals.normals[0] = {0, 0, 1};
    normals.normals[1] = glm::normalize(glm::vec3(std::tan(0.1f), 0, 1));
    normals.confidence = {1, 1, 0, 1};
    const AngularError error = angularError(normals, truth, std::vector<uint8_t>{1, 1, 1, 1});
    const double tenth = 0.1 * 180 / 3.14159265358979;
    EXPECT_EQ(error.pixels, 3u);
    EXPECT_EQ(error.missing, 1u);
    EXPECT_NEAR(error.mean, (0 + tenth + 90) / 3, 1e-4);
    EXPECT_NEAR(error.median, tenth, 1e-4);
    EXPECT_NEAR(error.percentile95, tenth + 0.9 * (90 - tenth), 1e-3);
}

TEST(Measures, SmallAnglesAreAccurate)
{
    EXPECT_NEAR(degreesBetween({1e-5f, 0, 1}, {0, 0, 1}), 1e-5 * 180 / 3.14159265358979, 1e-8);
}

} // namespace
} // namespace nacre
