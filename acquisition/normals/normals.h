#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/normals/intensities.h"

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

enum class NormalMethod { automatic, leastSquares, threshold, twoStep, ransac, consensus, exemplar };

// "auto", "least-squares", "threshold", "two-step", "ransac", "consensus", "exemplar"; a usage Error lists the names.
NormalMethod normalMethodFromName(const std::string& name);
std::string nameOf(NormalMethod method);
std::string normalMethodNames();

struct NormalOptions {
    NormalMethod method = NormalMethod::automatic;
    // threshold: observations outside are dropped. In radiance over irradiance, grey, if both are set (0 <= low <
    // high); otherwise the darkest and brightest shares of each pixel's own observations.
    float lowThreshold = -1;
    float highThreshold = -1;
    float darkestShare = 0.2f;
    float brightestShare = 0.25f;
    // two-step, ransac, consensus: at most so many triples of lights.
    size_t triples = 300;
    uint64_t seed = 1;
    // exemplar: published fits that are added to the built-in reflectances (empty: none), and names to leave out.
    std::filesystem::path fitsFolder;
    std::vector<std::string> excludedReflectances;
    int threads = 0;
};

// What photometric stereo says of one pixel.
struct PixelNormal {
    glm::vec3 normal{0};  // unit, camera frame; 0 where there is none
    float albedo = 0;     // rho of I / E = rho n.l (Lambertian methods), the exemplar's scale otherwise; grey
    float confidence = 0; // [0,1]; 0 = no data
    uint16_t used = 0;    // observations that the estimate rests on
};

struct NormalBlock {
    std::vector<PixelNormal> pixels;
    std::vector<Verdict> verdicts; // [pixel * lights + light]
};

// Answers a block of pixels. Made once per capture: what depends on the lights alone is in it.
using NormalEstimator = std::function<NormalBlock(const Intensities&)>;

NormalEstimator makeLeastSquaresEstimator(const std::vector<Light>& lights, const NormalOptions& options);
NormalEstimator makeThresholdEstimator(const std::vector<Light>& lights, const NormalOptions& options);
NormalEstimator makeTwoStepEstimator(const std::vector<Light>& lights, const NormalOptions& options);
NormalEstimator makeRansacEstimator(const std::vector<Light>& lights, const NormalOptions& options);
NormalEstimator makeConsensusEstimator(const std::vector<Light>& lights, const NormalOptions& options);

// What a method that looks at the whole object found out, for the user.
struct NormalReport {
    NormalMethod method = NormalMethod::automatic; // the one that was taken
    std::vector<Finding> findings;
    std::vector<CheckFigure> figures;                               // of the self-checks
    double heldOutError = std::numeric_limits<double>::quiet_NaN(); // that the choice rests on; NaN where it was none
    // Share of the mean, see lambertian_misfit.h; NaN where nothing is lit.
    double lambertianMisfit = std::numeric_limits<double>::quiet_NaN();
};

} // namespace nacre
