#include "tests/gpu/frame_match.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/gpu/gpu_test.h"

namespace nacre::test {
namespace {

// Both sides run the same formulas in 32-bit floats; what differs is the order of operations, the device's
// atan and sqrt (to some ulp) and the weights of its filter. The square root of the table's first axis turns 1e-7 of
// angle into 3e-4 of the axis beside the highlight's centre, where tables are flat.
constexpr float kOfValue = 1e-3f;
constexpr float kOfPeak = 1e-5f;
// Code values are rounded, so that equal radiance up to the bound above may fall on either side of one step.
constexpr float kOfPicture = 1.001f / 255;

// Filters of GPUs have 8 bits of weight, which miss the first bound at steep highlights by up to 27 times (imitated on
// the CPU); the picture's bound holds.
constexpr float kWiderOfEightBits = 32;

float largestDifference(const Image& a, const Image& b)
{
    float largest = 0;
    for (size_t i = 0; i < a.values.size(); ++i) {
        largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
    }
    return largest;
}

std::string keepForInspection(const Frame& actual, const Frame& expected)
{
    Frame difference = actual;
    for (size_t i = 0; i < difference.values.size(); ++i) {
        difference.values[i] = std::abs(difference.values[i] - expected.values[i]);
    }
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string stem = fmt::format("{}{}.{}", testing::TempDir(), test->test_suite_name(), test->name());
    saveImage(stem + ".actual.exr", actual, PixelType::float32);
    saveImage(stem + ".expected.exr", expected, PixelType::float32);
    saveImage(stem + ".difference.exr", difference, PixelType::float32);
    return stem;
}

} // namespace

testing::AssertionResult framesMatch(const Frame& actual, const Frame& expected)
{
    if (actual.width != expected.width || actual.height != expected.height || actual.channels != expected.channels) {
        return testing::AssertionFailure() << "sizes differ";
    }
    const float peak = *std::max_element(expected.values.begin(), expected.values.end());
    if (!(peak > 0)) {
        return testing::AssertionFailure() << "the expected frame is black";
    }
    const float wider = typeOfTestedDevice == "CPU" ? 1 : kWiderOfEightBits;
    size_t beyond = 0;
    float worst = 0;
    for (size_t i = 0; i < actual.values.size(); ++i) {
        const float bound = wider * kOfValue * std::abs(expected.values[i]) + kOfPeak * peak;
        const float difference = std::abs(actual.values[i] - expected.values[i]);
        // The negation counts NaN as well.
        beyond += !(difference <= bound);
        worst = std::max(worst, difference / bound);
    }
    const float stops = automaticExposure(expected);
    const float picture = largestDifference(displayedImage(actual, {.exposureStops = stops}),
                                            displayedImage(expected, {.exposureStops = stops}));
    const std::string figures =
        fmt::format("{} of {} values beyond the bound, the worst at {:.3f} of it; picture {:.2f}/255", beyond,
                    actual.values.size(), worst, picture * 255);
    if (beyond > 0 || picture > kOfPicture) {
        return testing::AssertionFailure()
               << figures << "; kept as " << keepForInspection(actual, expected) << ".*.exr";
    }
    return testing::AssertionSuccess() << figures;
}

} // namespace nacre::test
