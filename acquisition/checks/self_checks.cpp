#include "acquisition/checks/self_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/checks/light_misfit.h"
#include "acquisition/checks/matte_scatter.h"
#include "acquisition/checks/stability.h"
#include "acquisition/checks/what_if.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr size_t kMostPixels = 400;
constexpr size_t kCheckTriples = 100; // of lights: medians over pixels do not need each pixel's best one
constexpr size_t kFewestCheckedPixels = 50;
constexpr size_t kFewestCheckedLights = 5; // fewer are warned of as such, and explain anything

constexpr double kLargestMisfit = 2.5;       // degrees; spheres are read to 1 or 2
constexpr double kLargestInstability = 15;   // degrees; a dozen photographs of gloss have 10
constexpr double kLargestScatter = 0.02;     // a third above the worst of the photographs that are known to be good
constexpr double kLargestDifference = 3;     // degrees in the mean: two methods cannot both be right
constexpr double kLargestClipped = 0.1;      // of the lit observations
constexpr double kLargestShadowed = 0.2;     // of the observations that face their light
constexpr double kLargestUnexplained = 0.09; // of the brightness; good photographs have 0.06
constexpr float kFacing = 0.2f;              // n.l
// A floor under the values: of the bright ones, more than rounding and light from other parts leave (0.01 at most).
constexpr double kLargestFloor = 0.02;
constexpr float kTurnedAway = -0.1f; // n.l: by more than normals err where they count
constexpr size_t kFewestUnlit = 50;
// Of the floor: where light comes from other parts of the object, the median of what is turned away is far above it.
constexpr float kFloorSpread = 1.25f;

Observations thinned(const Observations& sample)
{
    const size_t n = sample.lightCount, step = sample.pixels.size() / kMostPixels + 1;
    Observations few;
    few.lightCount = n;
    few.width = sample.width;
    few.spacing = sample.spacing;
    for (size_t p = 0; p < sample.pixels.size(); p += step) {
        const auto radiance = sample.radianceOf(p);
        const auto saturated = sample.saturatedOf(p);
        few.pixels.push_back(sample.pixels[p]);
        few.radiance.insert(few.radiance.end(), radiance.begin(), radiance.end());
        few.saturated.insert(few.saturated.end(), saturated.begin(), saturated.end());
    }
    return few;
}

Finding findingOf(const CaptureDefect& defect, double scatter)
{
    const std::string gain = fmt::format("Lambert's law then misses matte parts by {:.1f} instead of {:.1f} %",
                                         100 * defect.scatter, 100 * scatter);
    switch (defect.kind) {
    case CaptureDefect::Kind::encoded:
        return {
            FindingCode::transferCurveLeft,
            fmt::format("the photographs are not linear (raised to the power {:.2g}, {}): a transfer curve is left in "
                        "them; decode them as sRGB, or give linear files",
                        defect.size, gain)};
    case CaptureDefect::Kind::decoded:
        return {
            FindingCode::transferCurveTaken,
            fmt::format("the photographs are not linear (raised to the power {:.2g}, {}): a transfer curve was taken "
                        "from them that they did not have; read them as linear",
                        defect.size, gain)};
    case CaptureDefect::Kind::nearLights:
        break;
    }
    return {FindingCode::lightsNear,
            fmt::format("the lights are not distant (at {:.2g} widths of the object, {}); give their distance "
                        "(--light-distance), move them away, or photograph less of the object",
                        defect.size, gain)};
}

// What is turned away from its light sees none of it: where its values lie together far above 0, every value has that
// much more than its light gives. 0 where they do not.
double floorOf(const CheckedSample& sample)
{
    std::vector<float> unlit, brightest;
    for (size_t p = 0; p < sample.seen.pixels.size(); ++p) {
        float most = 0;
        for (size_t i = 0; i < sample.lights.size(); ++i) {
            const float value = channelMean(sample.seen.radianceOf(p)[i]);
            const PixelNormal& pixel = sample.consensus.pixels[p];
            most = std::max(most, value);
            if (pixel.confidence > 0 && glm::dot(pixel.normal, sample.lights[i].direction) < kTurnedAway) {
                unlit.push_back(value);
            }
        }
        brightest.push_back(most);
    }
    if (unlit.size() < kFewestUnlit) {
        return 0;
    }
    const float floor = quantile(unlit, 0.1), bright = quantile(brightest, 0.9);
    return bright > 0 && quantile(unlit, 0.5) < kFloorSpread * floor ? floor / bright : 0;
}

// Shares of the observations that face their light.
struct Shares {
    double clipped = 0, shadowed = 0;
};

Shares sharesOf(const CheckedSample& sample)
{
    size_t facing = 0, clipped = 0, shadowed = 0;
    const size_t n = sample.lights.size();
    for (size_t p = 0; p < sample.seen.pixels.size(); ++p) {
        for (size_t i = 0; i < n; ++i) {
            if (glm::dot(sample.consensus.pixels[p].normal, sample.lights[i].direction) > kFacing) {
                ++facing;
                clipped += sample.seen.saturatedOf(p)[i] != 0;
                shadowed += sample.consensus.verdicts[p * n + i] == Verdict::shadow;
            }
        }
    }
    const double all = static_cast<double>(std::max<size_t>(1, facing));
    return {static_cast<double>(clipped) / all, static_cast<double>(shadowed) / all};
}

void judgeShares(const Shares& shares, SelfChecks& checks)
{
    checks.judge(FindingCode::clipped, shares.clipped, kLargestClipped,
                 fmt::format("{:.0f} % of what the lights reach is clipped; expose shorter, or take brackets",
                             100 * shares.clipped));
    checks.judge(FindingCode::shadowed, shares.shadowed, kLargestShadowed,
                 fmt::format("{:.0f} % of what faces a light is dark: cast shadows, or wrong lights; normals lean away "
                             "from what is in the way",
                             100 * shares.shadowed));
}

double meanDifference(const NormalBlock& a, const NormalBlock& b)
{
    double sum = 0, count = 0;
    for (size_t p = 0; p < a.pixels.size(); ++p) {
        if (a.pixels[p].confidence > 0 && b.pixels[p].confidence > 0) {
            sum += degreesBetween(a.pixels[p].normal, b.pixels[p].normal);
            ++count;
        }
    }
    return count > 0 ? sum / count : 0;
}

// Of the matrix of directions L: trace (L^T L)^-1, by which residuals grow into errors of normals.
double inverseGramTrace(const std::vector<Light>& lights)
{
    Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
    for (const Light& light : lights) {
        const Eigen::Vector3d l(light.direction.x, light.direction.y, light.direction.z);
        gram += l * l.transpose();
    }
    return gram.inverse().trace();
}

// What a method's own model leaves of the brightness, in the median: the residual scatter that its confidences tell,
// had each pixel all of the lights.
double unexplainedShare(const NormalBlock& block, const std::vector<Light>& lights)
{
    const double spread = std::sqrt(inverseGramTrace(lights));
    std::vector<float> shares;
    for (const PixelNormal& pixel : block.pixels) {
        const double confidence = std::max(pixel.confidence, 1e-3f);
        shares.push_back(static_cast<float>(kHalfConfidence * std::sqrt(1 / confidence - 1) / spread));
    }
    return shares.empty() ? 0 : quantile(shares, 0.5);
}

} // namespace

double lambertScatter(const Observations& sample, const std::vector<Light>& lights, const NormalOptions& options)
{
    const Observations few = thinned(sample);
    if (few.pixels.size() < kFewestCheckedPixels || lights.size() < kFewestCheckedLights) {
        return 0;
    }
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kCheckTriples);
    const Intensities intensities = intensitiesOf(few, lights);
    const NormalBlock consensus = makeConsensusEstimator(lights, quick)(intensities);
    return matteScatter(intensities, consensus, lights, matteObservations(intensities, consensus, lights));
}

CheckedSample checkCapture(const Observations& sample, const std::vector<Light>& lights, const NormalOptions& options)
{
    CheckedSample checked;
    SelfChecks& checks = checked.checks;
    checked.seen = thinned(sample);
    checked.lights = lights;
    if (checked.seen.pixels.size() < kFewestCheckedPixels || lights.size() < kFewestCheckedLights) {
        return checked;
    }
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kCheckTriples);
    checked.intensities = intensitiesOf(checked.seen, lights);
    checked.consensus = makeConsensusEstimator(lights, quick)(checked.intensities);
    checked.scatter = matteScatter(checked.intensities, checked.consensus, lights,
                                   matteObservations(checked.intensities, checked.consensus, lights));
    const DefectSearch search = findDefect(checked.seen, lights, quick, checked.scatter);
    checks.figures = search.figures;
    checked.defect = search.defect;
    const double floor = floorOf(checked);
    checks.judge(FindingCode::offsetLeft, floor, kLargestFloor,
                 fmt::format("what is turned away from its light still shows {:.1f} % of the bright values, all of it "
                             "alike: light that stays on, or the sensor's black; --offset auto, or a photograph "
                             "without the lights by --ambient",
                             100 * floor));
    if (checked.defect && floor <= kLargestFloor) { // a floor alone looks like a curve
        checks.findings.push_back(findingOf(*checked.defect, checked.scatter));
    }
    const double misfit = lightMisfitDegrees(checked.intensities, checked.consensus, lights);
    checks.judge(FindingCode::directionsContradicted, misfit, kLargestMisfit,
                 fmt::format("the photographs contradict the directions of their lights by {:.1f} degrees in the "
                             "median; check their order, or calibrate them anew",
                             misfit));
    checked.instability = instabilityDegrees(checked.intensities, lights, quick);
    checks.judge(FindingCode::normalsUnstable, checked.instability, kLargestInstability,
                 fmt::format("normals move by {:.1f} degrees with the choice of photographs: noise, wrong irradiances, "
                             "shadows, or too few lights; take more, or better exposed ones",
                             checked.instability));
    judgeShares(sharesOf(checked), checks);
    return checked;
}

SelfChecks checkMethod(const CheckedSample& sample, NormalMethod method, const NormalEstimator& estimator)
{
    SelfChecks checks;
    if (sample.consensus.pixels.empty()) {
        return checks;
    }
    const NormalBlock own = estimator(sample.intensities);
    const double difference = meanDifference(own, sample.consensus), unexplained = unexplainedShare(own, sample.lights);
    const bool knowsGloss = method == NormalMethod::exemplar;
    if (!knowsGloss) {
        checks.judge(FindingCode::notLambertian, sample.scatter, kLargestScatter,
                     fmt::format("even matte parts miss Lambert's law by {:.1f} %, on which {} rests: gloss, noise or "
                                 "wrong lights; exemplar knows gloss",
                                 100 * sample.scatter, nameOf(method)));
        // What consensus itself is unsure of says nothing against another method.
        checks.judge(
            FindingCode::methodsDisagree, difference, kLargestDifference + sample.instability,
            fmt::format("normals by {} and by consensus are {:.1f} degrees apart in the mean: gloss or shadows "
                        "are taken for shading; consensus or exemplar are safer",
                        nameOf(method), difference));
    }
    checks.judge(FindingCode::unexplained, unexplained,
                 knowsGloss ? kLargestUnexplained : std::numeric_limits<double>::infinity(),
                 fmt::format("no reflectance explains the photographs to better than {:.0f} % of their brightness: "
                             "noise, wrong lights, or several materials (--segment auto)",
                             100 * unexplained));
    return checks;
}

} // namespace nacre
