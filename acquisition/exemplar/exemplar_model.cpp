#include "acquisition/exemplar/exemplar_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/exemplar/exemplar_reestimation.h"
#include "acquisition/exemplar/object_exemplar.h"
#include "acquisition/exemplar/reflectance_dictionary.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kCoarseSize = 32; // texels across: 3.6 degrees in the middle
constexpr size_t kChosenExemplars = 6;
constexpr size_t kPixelsToChoose = 300;
// Consensus is off by less on diffuse materials; the radius doubles while matches crowd at its border.
constexpr float kFirstRadius = 22;    // degrees
constexpr float kLargestRadius = 88;  // degrees
constexpr float kCrowdedShare = 0.8f; // of the radius
// The object's scales: within so many robust standard deviations of log scale, at least kLeastLogSpread.
constexpr float kScaleSigmas = 3;
constexpr float kLeastLogSpread = 0.05f;

struct Trial {
    double cost = 0;   // mean over the few pixels
    ScaleRange scales; // that the object has under this reflectance
    float reach = 0;   // degrees: the 90th percentile of how far matches lie from their starts
};

// From the better half of the matches: one object has one material, up to its texture.
ScaleRange scalesOf(std::vector<Match> matches)
{
    std::stable_sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) { return a.cost < b.cost; });
    std::vector<float> logs, deviations;
    for (size_t i = 0; i < (matches.size() + 1) / 2; ++i) {
        if (matches[i].scale > 0) {
            logs.push_back(std::log(matches[i].scale));
        }
    }
    if (logs.empty()) {
        return {};
    }
    const float median = quantile(logs, 0.5);
    for (const float value : logs) {
        deviations.push_back(std::abs(value - median));
    }
    const float spread = kScaleSigmas * std::max(kLeastLogSpread, 1.4826f * quantile(deviations, 0.5));
    return {std::exp(median - spread), std::exp(median + spread)};
}

// The pixels that choose: their observations, and the square roots of them.
struct FewPixels {
    Intensities intensities;
    Intensities roots;
    std::vector<glm::vec3> starts;
};

std::vector<Match> matchAll(const PredictedBall& ball, const FewPixels& few, const std::vector<float>& weights,
                            float cosRadius, const ScaleRange& scales)
{
    std::vector<Match> matches;
    for (size_t p = 0; p < few.starts.size(); ++p) {
        MatchTarget target = targetOf(few.intensities, p, weights);
        target.roots = few.roots.padded(p);
        matches.push_back(findBestMatch(ball, target, few.starts[p], cosRadius, scales));
    }
    return matches;
}

FewPixels choosePixels(const Intensities& sample, const std::vector<glm::vec3>& starts)
{
    const size_t count = std::min(kPixelsToChoose, sample.pixelCount());
    FewPixels few{makeIntensities(count, sample.lightCount), {}, std::vector<glm::vec3>(count)};
    for (size_t j = 0; j < count; ++j) {
        const size_t p = (2 * j + 1) * sample.pixelCount() / (2 * count); // spread evenly
        std::copy_n(sample.padded(p), sample.stride, &few.intensities.values[j * sample.stride]);
        few.starts[j] = starts[p];
    }
    few.roots = few.intensities;
    for (float& value : few.roots.values) {
        value = std::sqrt(std::max(value, 0.0f));
    }
    return few;
}

// Free scales first; then again with the scales that the object showed.
Trial tryReflectance(const PredictedBall& ball, const FewPixels& few, const std::vector<float>& weights,
                     float radiusDegrees)
{
    const float cosRadius = std::cos(glm::radians(radiusDegrees));
    Trial trial;
    trial.scales = scalesOf(matchAll(ball, few, weights, cosRadius, {}));
    std::vector<float> reaches;
    const std::vector<Match> matches = matchAll(ball, few, weights, cosRadius, trial.scales);
    for (size_t p = 0; p < matches.size(); ++p) {
        trial.cost += std::min(1.0f, matches[p].cost) / static_cast<double>(matches.size());
        reaches.push_back(matches[p].row < 0
                              ? 0.0f
                              : static_cast<float>(degreesBetween(ball.normals[matches[p].row], few.starts[p])));
    }
    trial.reach = quantile(reaches, 0.9);
    return trial;
}

struct Ranking {
    std::vector<Trial> trials;
    std::vector<size_t> order; // indices of the dictionary, best first
    float radiusDegrees = 0;
};

Ranking rankReflectances(const std::vector<PredictedBall>& balls, const FewPixels& few,
                         const std::vector<float>& weights, int threads)
{
    Ranking ranking;
    for (float radius = kFirstRadius;; radius *= 2) {
        ranking = {std::vector<Trial>(balls.size()), std::vector<size_t>(balls.size()), radius};
        parallelFor(balls.size(), 1, threads, [&](size_t r, size_t) {
            ranking.trials[r] = tryReflectance(balls[r], few, weights, radius);
            ranking.order[r] = r;
        });
        std::stable_sort(ranking.order.begin(), ranking.order.end(),
                         [&](size_t a, size_t b) { return ranking.trials[a].cost < ranking.trials[b].cost; });
        if (ranking.trials[ranking.order.front()].reach < kCrowdedShare * radius || 2 * radius > kLargestRadius) {
            return ranking;
        }
    }
}

} // namespace

ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<glm::vec3>& starts,
                                const std::vector<Light>& lights, const NormalOptions& options,
                                std::vector<Finding>& findings)
{
    const std::vector<NamedBrdf> dictionary =
        makeReflectanceDictionary(options.fitsFolder, options.excludedReflectances);
    const std::vector<glm::vec3> directions = directionsOf(lights);
    const auto reflectanceOf = [&](size_t r) -> GreyReflectance {
        return [&, r](const glm::vec3& n, const glm::vec3& l) {
            return greyOf(evaluate(dictionary[r].model, n, l, {0, 0, 1}));
        };
    };
    std::vector<PredictedBall> coarse;
    for (size_t r = 0; r < dictionary.size(); ++r) {
        coarse.push_back(makePredictedBall(kCoarseSize, directions, reflectanceOf(r), options.threads));
    }
    const FewPixels few = choosePixels(sample, starts);
    const std::vector<float> everyLight = allLights(lights.size());
    const Ranking ranking = rankReflectances(coarse, few, everyLight, options.threads);

    ExemplarModel model;
    model.cosRadius = std::cos(glm::radians(ranking.radiusDegrees));
    for (size_t j = 0; j < std::min(kChosenExemplars, dictionary.size()); ++j) {
        const size_t r = ranking.order[j];
        model.exemplars.push_back({dictionary[r].name, std::move(coarse[r]),
                                   makePredictedBall(kFineBallSize, directions, reflectanceOf(r), options.threads),
                                   ranking.trials[r].scales});
    }
    findings.push_back(
        {FindingCode::reflectanceChosen,
         fmt::format(
             "exemplars: {} reflectances; {} explains the object best (cost {:.3f}), searched {:.0f} degrees around",
             dictionary.size(), model.exemplars.front().name, ranking.trials[ranking.order.front()].cost,
             ranking.radiusDegrees)});
    reestimate(model, sample, starts, lights, options.threads, findings);
    return model;
}

} // namespace nacre
