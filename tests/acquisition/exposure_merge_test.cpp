#include "acquisition/capture/exposure_merge.h"

#include <array>

#include <gtest/gtest.h>

namespace nacre {
namespace {

constexpr float kRounding = 1e-6f; // of a few float operations on values near 1

const ExposureScale kLong = exposureScaleOf("uint16", 1.0);
const ExposureScale kShort = exposureScaleOf("uint16", 0.125);

MergedPixel merge(const glm::vec3& longValue, const glm::vec3& shortValue)
{
    return mergeExposures(std::array{longValue, shortValue}, std::array{kLong, kShort});
}

TEST(ExposureMerge, KnowsFullScales)
{
    EXPECT_EQ(exposureScaleOf("uint8", 1).fullScale, 255.0f);
    EXPECT_EQ(exposureScaleOf("uint16", 1).fullScale, 65535.0f);
    EXPECT_EQ(exposureScaleOf("int16", 1).fullScale, 32767.0f);
    EXPECT_EQ(exposureScaleOf("uint", 1).fullScale, 4294967295.0f);
    EXPECT_FALSE(exposureScaleOf("float", 1).isInteger());
    EXPECT_FALSE(exposureScaleOf("half", 1).isInteger());
}

TEST(ExposureMerge, ASingleExposureIsDividedByItsTime)
{
    const MergedPixel merged = mergeExposures(std::array{glm::vec3(0.1f, 0.2f, 0.4f)}, std::array{kShort});
    EXPECT_EQ(merged.radiance, glm::vec3(0.8f, 1.6f, 3.2f));
    EXPECT_FALSE(merged.saturated);
}

TEST(ExposureMerge, ASingleExposureSaturatesAtFullScaleAlone)
{
    const auto saturated = [](float value, const char* type) {
        return mergeExposures(std::array{glm::vec3(0.5f, value, 0)}, std::array{exposureScaleOf(type, 1)}).saturated;
    };
    EXPECT_TRUE(saturated(1, "uint8"));
    EXPECT_FALSE(saturated(254.0f / 255, "uint8"));
    EXPECT_TRUE(saturated(1, "uint16"));
    EXPECT_FALSE(saturated(65534.0f / 65535, "uint16"));
    EXPECT_FALSE(saturated(1, "float"));
    EXPECT_FALSE(saturated(100, "half"));
}

TEST(ExposureMerge, AgreeingExposuresGiveTheirRadiance)
{
    for (const float radiance : {0.0f, 0.001f, 0.1f, 0.5f, 0.97f}) {
        const MergedPixel merged = merge(glm::vec3(radiance), glm::vec3(radiance * 0.125f));
        EXPECT_NEAR(merged.radiance.x, radiance, kRounding);
        EXPECT_FALSE(merged.saturated);
    }
}

TEST(ExposureMerge, ClippedExposuresCountNothing)
{
    // Full scale stands for 8 in truth: the short exposure alone knows. Channels are apart.
    const MergedPixel merged = merge({1, 0.98f, 0.5f}, {0.5f, 0.2f, 0.0625f});
    EXPECT_NEAR(merged.radiance.x, 4, 4 * kRounding);
    EXPECT_NEAR(merged.radiance.y, 1.6f, 2 * kRounding);
    EXPECT_NEAR(merged.radiance.z, 0.5f, kRounding);
    EXPECT_FALSE(merged.saturated);
}

TEST(ExposureMerge, WhereAllAreClippedTheShortestStands)
{
    const MergedPixel merged = merge({1, 0.5f, 0.5f}, {0.99f, 0.0625f, 0.0625f});
    EXPECT_NEAR(merged.radiance.x, 8 * 0.99f, 8 * kRounding);
    EXPECT_TRUE(merged.saturated);
}

TEST(ExposureMerge, LongExposuresWeighMoreByTheirTime)
{
    // Both in the flat of the hat: (1 * 0.5 + 0.125 * 0.6) / 1.125 but for the hat's few thousandths.
    const MergedPixel merged = merge(glm::vec3(0.5f), glm::vec3(0.6f * 0.125f));
    const float byTimeAlone = (0.5f + 0.125f * 0.6f) / 1.125f;
    EXPECT_LT(merged.radiance.x, byTimeAlone); // the short one lies on the hat's rising edge
    EXPECT_NEAR(merged.radiance.x, byTimeAlone, 0.01f);
}

TEST(ExposureMerge, BlackWeighsLittle)
{
    // The black level of a short exposure must not pull: 1e-3 of the weight of a short exposure in the hat's flat.
    const MergedPixel merged = merge(glm::vec3(0.4f), glm::vec3(0));
    EXPECT_NEAR(merged.radiance.x, 0.4f, 1e-3f * 0.125f * 0.4f * 1.01f);
}

TEST(ExposureMerge, FloatsNeverSaturate)
{
    const std::array scales{exposureScaleOf("float", 1), exposureScaleOf("float", 0.5)};
    const MergedPixel merged = mergeExposures(std::array{glm::vec3(40), glm::vec3(20)}, scales);
    EXPECT_NEAR(merged.radiance.x, 40, 40 * kRounding);
    EXPECT_FALSE(merged.saturated);
}

} // namespace
} // namespace nacre
