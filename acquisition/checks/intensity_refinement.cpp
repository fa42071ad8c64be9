#include "acquisition/checks/intensity_refinement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr int kMostIterations = 60;
// Steps in log ratio are lengthened: alternation alone creeps where few lights share few normals.
constexpr float kOverRelaxation = 1.5f;
// Ratios that move by less than this are at rest.
constexpr float kRest = 0.002f;
// Medians over thousands of pixels do not need each pixel's best triple.
constexpr size_t kTriples = 100;
// Pixels that a light grazes say little of its strength.
constexpr float kLeastRefinedCosine = 0.3f;
constexpr size_t kFewestPixels = 20;
// With fewer lights a pixel's normal follows whatever a photograph claims.
constexpr size_t kFewestLights = 6;
// A photograph disagrees when its log ratio is beyond this and beyond so many of the photographs' own spreads: what is
// not Lambert makes ratios scatter, too.
constexpr float kLeastDeviation = 0.095f; // 10 %
constexpr float kDeviationSigmas = 5;

// Observation over prediction per channel: the prediction is the pixel's own albedo in the channel times n.l.
struct ChannelRatios {
    std::vector<float> values[3];
    std::vector<float> grey;
    size_t shadowed = 0; // pixels that face the light, but are dark
};

std::vector<ChannelRatios> gatherRatios(const Observations& sample, const NormalBlock& normals,
                                        const std::vector<Light>& lights)
{
    std::vector<ChannelRatios> ratios(lights.size());
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const PixelNormal& pixel = normals.pixels[p];
        const Verdict* verdicts = &normals.verdicts[p * lights.size()];
        const auto radiance = sample.radianceOf(p);
        glm::vec3 sum(0);
        float squares = 0;
        for (size_t i = 0; i < lights.size(); ++i) {
            const float nDotL = glm::dot(pixel.normal, lights[i].direction);
            if (verdicts[i] == Verdict::used && nDotL > 0) {
                sum += nDotL * radiance[i] / lights[i].irradiance;
                squares += nDotL * nDotL;
            }
        }
        for (size_t i = 0; i < lights.size(); ++i) {
            const float nDotL = glm::dot(pixel.normal, lights[i].direction);
            if (squares <= 0 || nDotL < kLeastRefinedCosine) {
                continue;
            }
            if (verdicts[i] == Verdict::shadow) {
                ++ratios[i].shadowed;
            } else {
                const glm::vec3 ratio = radiance[i] / lights[i].irradiance * squares / (sum * nDotL);
                for (int c = 0; c < 3; ++c) {
                    if (std::isfinite(ratio[c])) {
                        ratios[i].values[c].push_back(ratio[c]);
                    }
                }
                const float grey = greyOf(radiance[i] / lights[i].irradiance) * squares / (greyOf(sum) * nDotL);
                if (std::isfinite(grey)) {
                    ratios[i].grey.push_back(grey);
                }
            }
        }
    }
    return ratios;
}

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

// Robust relative standard deviation of one photograph's ratios.
PhotographScatter scatterOf(ChannelRatios& ratios)
{
    PhotographScatter scatter;
    std::vector<float>& grey = ratios.grey;
    scatter.litShare = static_cast<float>(grey.size()) / std::max<size_t>(1, grey.size() + ratios.shadowed);
    if (grey.size() >= kFewestPixels) {
        const float median = quantile(grey, 0.5);
        for (float& value : grey) {
            value = std::abs(value / median - 1);
        }
        scatter.spread = 1.4826f * quantile(grey, 0.5);
    }
    return scatter;
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

// Ratios of the photographs that are free; the others' stay 1. Without a fixed one the scale is the median's.
PhotographRatios refineRatios(const Observations& sample, const std::vector<Light>& lights,
                              const NormalOptions& options, const std::vector<bool>& isFree)
{
    PhotographRatios result;
    result.ratios.assign(lights.size(), glm::vec3(1));
    const bool allFree = std::find(isFree.begin(), isFree.end(), false) == isFree.end();
    std::vector<Light> current = lights;
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kTriples);
    const NormalEstimator consensus = makeConsensusEstimator(lights, quick); // knows directions alone
    for (; result.iterations < kMostIterations; ++result.iterations) {
        const NormalBlock normals = consensus(intensitiesOf(sample, current));
        std::vector<ChannelRatios> gathered = gatherRatios(sample, normals, current);
        std::vector<glm::vec3> next = result.ratios;
        for (size_t i = 0; i < lights.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                std::vector<float>& values = gathered[i].values[c];
                const bool knows = isFree[i] && values.size() >= kFewestPixels;
                const float ratio = knows ? quantile(values, 0.5) : 1.0f;
                next[i][c] *= ratio > 0 ? std::pow(ratio, kOverRelaxation) : 1.0f;
            }
        }
        if (allFree) {
            fixScale(next);
        }
        const float change = steepestStep(result.ratios, next);
        for (size_t i = 0; i < lights.size(); ++i) {
            current[i].irradiance = lights[i].irradiance * next[i];
        }
        result.ratios = next;
        if (change < kRest || result.iterations + 1 == kMostIterations) {
            result.scatters.clear();
            std::transform(gathered.begin(), gathered.end(), std::back_inserter(result.scatters), scatterOf);
        }
        if (change < kRest) {
            break;
        }
    }
    result.spread = spreadOf(result.ratios);
    return result;
}

} // namespace

bool canCompare(const Observations& sample)
{
    return sample.lightCount >= kFewestLights && sample.pixels.size() >= kFewestPixels;
}

std::vector<Finding> correctIntensities(const PhotographRatios& found, const std::vector<std::string>& names,
                                        bool known, std::vector<Light>& lights)
{
    std::vector<Finding> remarks;
    if (!known) {
        remarks.push_back(
            {FindingCode::intensitiesEstimated,
             fmt::format("intensities estimated from the photographs themselves in {} steps: {:.2f} to {:.2f}",
                         found.iterations, leastGrey(found.ratios), largestGrey(found.ratios))});
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
                 "were corrected: {}",
                 corrected.size(), leastGrey(corrected), largestGrey(corrected), corrections)});
    }
    return remarks;
}

PhotographRatios estimateIntensityRatios(const Observations& sample, const std::vector<Light>& lights,
                                         const NormalOptions& options)
{
    return refineRatios(sample, lights, options, std::vector<bool>(lights.size(), true));
}

PhotographRatios confirmedRatios(const PhotographRatios& found, const Observations& sample,
                                 const std::vector<Light>& lights, const NormalOptions& options)
{
    std::vector<bool> isDoubted;
    for (size_t i = 0; i < lights.size(); ++i) {
        isDoubted.push_back(disagrees(found, i));
    }
    if (std::find(isDoubted.begin(), isDoubted.end(), true) == isDoubted.end()) {
        return found;
    }
    PhotographRatios confirmed = refineRatios(sample, lights, options, isDoubted);
    confirmed.spread = found.spread; // the photographs' own scatter, which fixed ratios do not show
    return confirmed;
}

} // namespace nacre
