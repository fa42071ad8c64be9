#include "acquisition/checks/intensity_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "acquisition/checks/ratio_response.h"
#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Alternation comes close from afar, though slowly: its steps in log ratio are lengthened. Newton's steps are exact
// close by, where it creeps.
constexpr double kOverRelaxation = 1.5;
constexpr float kClose = 0.02f; // alternation that moves ratios by less is close
constexpr float kRest = 0.002f; // ratios that move by less are at rest
// So are ratios that miss their medians by less (root mean square) and came no closer in so many steps: medians of few
// pixels jump.
constexpr double kJumps = 0.01;
constexpr int kIdleSteps = 5;
// Medians over thousands of pixels do not need each pixel's best triple.
constexpr size_t kTriples = 100;
// With fewer lights a pixel's normal follows whatever a photograph claims.
constexpr size_t kFewestLights = 6;
// Of ratios, as an estimate of how far equal lights differ: 1 %, which few photographs are better than.
constexpr double kLeastSpread = 0.01;
// A photograph disagrees when its log ratio is beyond this and beyond so many of the photographs' own spreads: what is
// not Lambert makes ratios scatter, too.
constexpr float kLeastDeviation = 0.095f; // 10 %
constexpr float kDeviationSigmas = 5;

// One factor for all lights is not known: the median light keeps its irradiance.
void fixScale(std::vector<glm::vec3>& ratios)
{
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (const glm::vec3& ratio : ratios) {
            values.push_back(ratio[c]);
        }
        const float median = quantile(values, 0.5);
        for (glm::vec3& ratio : ratios) {
            ratio[c] /= median;
        }
    }
}

float leastGrey(const std::vector<glm::vec3>& ratios)
{
    float least = greyOf(ratios.front());
    for (const glm::vec3& ratio : ratios) {
        least = std::min(least, greyOf(ratio));
    }
    return least;
}

float largestGrey(const std::vector<glm::vec3>& ratios)
{
    float largest = greyOf(ratios.front());
    for (const glm::vec3& ratio : ratios) {
        largest = std::max(largest, greyOf(ratio));
    }
    return largest;
}

float spreadOf(const std::vector<glm::vec3>& ratios)
{
    std::vector<float> deviations;
    for (const glm::vec3& ratio : ratios) {
        deviations.push_back(std::abs(std::log(greyOf(ratio))));
    }
    return 1.4826f * quantile(deviations, 0.5);
}

bool disagrees(const PhotographRatios& found, size_t photograph)
{
    const float limit = std::max(kLeastDeviation, kDeviationSigmas * found.spread);
    return std::abs(std::log(greyOf(found.ratios[photograph]))) > limit;
}

float steepestStep(const std::vector<glm::vec3>& from, const std::vector<glm::vec3>& to)
{
    float steepest = 0;
    for (size_t i = 0; i < from.size(); ++i) {
        const glm::vec3 step = glm::abs(glm::log(to[i] / from[i]));
        steepest = std::max({steepest, step.x, step.y, step.z});
    }
    return steepest;
}

Eigen::VectorXd logarithmsOf(const std::vector<glm::vec3>& ratios)
{
    Eigen::VectorXd logs(ratios.size());
    for (size_t i = 0; i < ratios.size(); ++i) {
        logs(static_cast<Eigen::Index>(i)) = std::log(greyOf(ratios[i]));
    }
    return logs;
}

// Noise over signal: the square of the pixels' usual scatter over how far the lights themselves differ.
double priorOf(const PhotographRatios& found)
{
    std::vector<float> scatters;
    for (const PhotographScatter& scatter : found.scatters) {
        scatters.push_back(scatter.spread);
    }
    const Eigen::VectorXd logs = logarithmsOf(found.ratios);
    const double spread = std::sqrt((logs.array() - logs.mean()).square().mean());
    return std::pow(quantile(scatters, 0.5) / std::max(kLeastSpread, spread), 2);
}

std::vector<Light> scaled(std::vector<Light> lights, const std::vector<glm::vec3>& ratios)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].irradiance *= ratios[i];
    }
    return lights;
}

// Where ratios start from. Those that are close to their end are improved by Newton's steps from the first on.
struct RatioStart {
    std::vector<glm::vec3> ratios;
    bool isClose = false;
};

// Ratios of the photographs that are free; the others' stay 1. Without a fixed one the scale is the median's, and
// what the photographs tell of the ratios is weighed against their being equal. All are 1 where they do not settle.
PhotographRatios refineRatios(const Observations& sample, const std::vector<Light>& lights,
                              const NormalOptions& options, const std::vector<bool>& isFree, const RatioStart& start,
                              int mostIterations)
{
    PhotographRatios result;
    result.ratios = start.ratios;
    const bool allFree = std::find(isFree.begin(), isFree.end(), false) == isFree.end();
    std::vector<Light> current = scaled(lights, result.ratios);
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kTriples);
    const NormalEstimator consensus = makeConsensusEstimator(lights, quick); // knows directions alone
    bool isClose = start.isClose;
    double prior = 0, least = std::numeric_limits<double>::infinity();
    int idle = 0; // steps since the least miss
    for (; result.iterations < mostIterations && !result.settled; ++result.iterations) {
        const NormalBlock normals = consensus(intensitiesOf(sample, current));
        std::vector<FacingRatios> gathered = gatherRatios(sample, normals, current, options.threads);
        const MedianRatios medians = mediansOf(gathered, isFree, options.threads);
        const Eigen::VectorXd missed = medians.logs - prior * logarithmsOf(result.ratios)(medians.photographs);
        const double miss = missed.norm() / std::sqrt(std::max<double>(1, static_cast<double>(missed.size())));
        idle = miss < least ? 0 : idle + 1;
        least = std::min(least, miss);
        Eigen::VectorXd step = kOverRelaxation * medians.logs;
        if (isClose && !medians.photographs.empty()) {
            step = newtonStep(medians, missed, responseOf(normals, lights), prior, allFree);
        }
        std::vector<glm::vec3> next = result.ratios;
        for (size_t k = 0; k < medians.photographs.size(); ++k) {
            next[medians.photographs[k]] *= medians.colours[k] * static_cast<float>(std::exp(step(k)));
        }
        if (allFree) {
            fixScale(next);
        }
        const float change = steepestStep(result.ratios, next);
        current = scaled(lights, next);
        result.ratios = next;
        result.settled = isClose && (change < kRest || (idle >= kIdleSteps && miss < kJumps));
        const bool becomesClose = !isClose && change < kClose;
        if (result.settled || becomesClose) {
            result.scatters = scattersOf(gathered, options.threads);
        }
        if (becomesClose) {
            isClose = true;
            least = std::numeric_limits<double>::infinity();
            prior = allFree ? priorOf(result) : 0;
        }
    }
    if (!result.settled) {
        const RatioStart allOnes{std::vector<glm::vec3>(lights.size(), glm::vec3(1))};
        // With none free it settles at once.
        PhotographRatios asGiven =
            refineRatios(sample, lights, options, std::vector<bool>(lights.size(), false), allOnes, kMostIterations);
        asGiven.settled = false;
        asGiven.iterations = result.iterations;
        return asGiven;
    }
    result.spread = spreadOf(result.ratios);
    return result;
}

} // namespace

bool canCompare(const Observations& sample)
{
    return sample.lightCount >= kFewestLights && sample.pixels.size() >= kFewestRatioPixels;
}

std::vector<Finding> correctIntensities(const PhotographRatios& found, const std::vector<std::string>& names,
                                        bool known, std::vector<Light>& lights)
{
    std::vector<Finding> remarks;
    const double condition = conditionOf(lights);
    const bool illPlaced = condition > kWorstTellingCondition;
    if (!found.settled && known) {
        return {}; // they stay as given
    }
    if (!found.settled) {
        return {{FindingCode::intensitiesUncertain,
                 fmt::format("the intensities do not settle in {} steps: the lights are taken to be equally strong",
                             found.iterations)}};
    }
    if (!known) {
        remarks.push_back(
            {FindingCode::intensitiesEstimated,
             fmt::format("intensities estimated from the photographs themselves in {} steps: {:.2f} to {:.2f}",
                         found.iterations, leastGrey(found.ratios), largestGrey(found.ratios))});
        if (illPlaced) {
            remarks.push_back(
                {FindingCode::intensitiesUncertain,
                 fmt::format("the lights are ill placed (condition {:.1f}; up to {:.0f} is good): their intensities "
                             "hardly differ from a tilt of the object, and stay near equal where the photographs do "
                             "not tell; measure them",
                             condition, kWorstTellingCondition)});
        }
    }
    std::vector<glm::vec3> corrected;
    std::string corrections;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (!known || disagrees(found, i)) {
            lights[i].irradiance *= found.ratios[i];
        }
        if (known && disagrees(found, i)) {
            corrected.push_back(found.ratios[i]);
            corrections += (corrections.empty() ? "" : ", ") + names[i];
        }
    }
    if (!corrected.empty()) {
        remarks.push_back(
            {FindingCode::intensitiesCorrected,
             fmt::format(
                 "{} photograph(s) are {:.2f} to {:.2f} times as bright as the others predict; their intensities "
                 "were corrected: {}{}",
                 corrected.size(), leastGrey(corrected), largestGrey(corrected), corrections,
                 illPlaced
                     ? fmt::format("; the others stay as given, since the lights are ill placed (condition {:.1f})",
                                   condition)
                     : "")});
    }
    return remarks;
}

PhotographRatios estimateIntensityRatios(const Observations& sample, const std::vector<Light>& lights,
                                         const NormalOptions& options, int mostIterations)
{
    const RatioStart allOnes{std::vector<glm::vec3>(lights.size(), glm::vec3(1))};
    return refineRatios(sample, lights, options, std::vector<bool>(lights.size(), true), allOnes, mostIterations);
}

PhotographRatios confirmedRatios(const PhotographRatios& found, const Observations& sample,
                                 const std::vector<Light>& lights, const NormalOptions& options)
{
    std::vector<bool> isDoubted;
    RatioStart start{{}, true};
    for (size_t i = 0; i < lights.size(); ++i) {
        isDoubted.push_back(disagrees(found, i));
        start.ratios.push_back(isDoubted[i] ? found.ratios[i] : glm::vec3(1));
    }
    if (std::find(isDoubted.begin(), isDoubted.end(), true) == isDoubted.end()) {
        return found;
    }
    PhotographRatios confirmed = refineRatios(sample, lights, options, isDoubted, start, kMostIterations);
    confirmed.spread = found.spread; // the photographs' own scatter, which fixed ratios do not show
    return confirmed;
}

} // namespace nacre
