#pragma once
#include <cstdint>
#include <span>

namespace nacre {

// What an observation is to its pixel's model.
enum class Verdict : uint8_t {
    used,      // explained
    shadow,    // attached (n.l <= 0) or darker than the model by more than its own scatter
    highlight, // brighter than a model that knows no highlight
    saturated, // clipped in every exposure: its value is not known
};

// One pixel's verdicts from its observations and what the model predicts of them. The tolerance is the pixel's own
// scatter: three robust standard deviations of the lit residuals, at least kLeastTolerance of its 90th percentile.
constexpr float kLeastTolerance = 0.05f; // calibration and interreflection, as photographs have them
void judge(std::span<const float> observed, std::span<const float> predicted, std::span<Verdict> verdicts);

// Standard error of a normal in radians: the scatter of the used residuals over the albedo, through the lights that
// are left. Infinite where they are fewer than three or lie in one plane.
float normalUncertainty(float residualScatter, float albedo, float inverseGramTrace);

// Confidence in [0,1] of a standard error in radians: 1/2 at kHalfConfidence.
constexpr float kHalfConfidence = 0.0873f; // 5 degrees
float confidenceOf(float uncertainty);

} // namespace nacre
