#include "evaluation/held_out/held_out_measures.h"

#include <cmath>

#include <gtest/gtest.h>

namespace nacre {
namespace {

Image greyPicture(const std::vector<float>& values)
{
    Image picture(static_cast<int>(values.size()), 1, 3);
    for (int x = 0; x < picture.width; ++x) {
        picture.setRgb(x, 0, glm::vec3(values[x]));
    }
    return picture;
}

TEST(HeldOutMeasures, RelativeErrorsAreThoseComputedByHand)
{
    const Image photograph = greyPicture({0.5f, 0.2f, 0.001f, 0.9f}), predicted = greyPicture({0.4f, 0.3f, 0.002f, 0});
    const std::vector<uint8_t> mask = {1, 1, 1, 0};
    const std::vector<float> errors = relativeErrors(predicted, photograph, mask, 0.01);
    ASSERT_EQ(errors.size(), 9u); // three channels of the three pixels in the mask
    EXPECT_NEAR(errors[0], 0.1 / 0.5, 1e-6);
    EXPECT_NEAR(errors[3], 0.1 / 0.2, 1e-6);
    EXPECT_NEAR(errors[6], 0.001 / 0.01, 1e-6) << "against the floor, not against 0.001";
}

TEST(HeldOutMeasures, APhotographIsMeasuredAsByHand)
{
    const Image photograph = greyPicture({0.5f, 0.5f, 0.5f, 0.5f}), predicted = greyPicture({0.5f, 0.4f, 0.6f, 0.5f});
    const std::vector<uint8_t> mask(4, 1);
    const PhotographMeasures measures = measurePhotograph(predicted, photograph, mask, 1);
    EXPECT_NEAR(measures.psnr, -10 * std::log10(0.02 / 4), 1e-3);
    EXPECT_NEAR(measures.medianRelativeError, 0.1, 1e-5); // 0, 0, 0.2, 0.2, between order statistics
    EXPECT_NEAR(measures.percentile95RelativeError, 0.2, 1e-5);
    EXPECT_LT(measures.structuralSimilarity, 1);
    EXPECT_NEAR(measurePhotograph(photograph, photograph, mask, 1).structuralSimilarity, 1, 1e-9);
}

TEST(HeldOutMeasures, PsnrPoolsErrorsAfterClippingAtThePeak)
{
    Observations heldOut;
    heldOut.lightCount = 2;
    heldOut.pixels = {0};
    heldOut.radiance = {glm::vec3(1), glm::vec3(4)};
    const Predictions predicted = {glm::vec3(0.8f), glm::vec3(9)};
    // Of peak 2: 0.5 against 0.4, and 1 against 1 where both are beyond it.
    EXPECT_NEAR(pooledPsnr(predicted, heldOut, 2), -10 * std::log10(0.01 / 2), 1e-4);
}

TEST(HeldOutMeasures, BytesAreThoseOfTheTablesOrOfWhatReplacedThem)
{
    Surface surface;
    Material full{"full", BrdfTable({4, 3, 2}, {}), {}, {}};
    Material small{"small", BrdfTable({4, 3, 2}, {}), {}, {}};
    small.compact = SmallTable{BrdfTable({2, 2, 2}, {}), TexelFormat::e5b9g9r9};
    surface.materials = {full, small};
    EXPECT_EQ(modelBytes(surface), 4u * 3 * 2 * 16 + 2 * 2 * 2 * 4);
}

} // namespace
} // namespace nacre
