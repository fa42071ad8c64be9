#include "acquisition/exemplar/exemplar_model.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/normals/light_triples.h"
#include "engine/brdf/brdf_models.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// ABC lobes D = A / (1 + B (1 - cos thetaH))^C (Loew et al. 2012): B sets the width (1/sqrt(B) radians), C the tail.
constexpr float kLobeWidths[] = {20, 150, 1000, 7000, 50000};
constexpr float kLobeTails[] = {0.6f, 1.0f, 1.6f, 2.6f};
// The lobe's peak over the diffuse part; 0: no diffuse part, as in metals.
constexpr float kLobePeaks[] = {0.3f, 1.5f, 6, 25, 100, 0};
constexpr float kLobeIor = 1.6f;

NamedBrdf builtInLobe(float width, float tail, float peak)
{
    const float f0 = (kLobeIor - 1) * (kLobeIor - 1) / ((kLobeIor + 1) * (kLobeIor + 1));
    AbcModel model;
    model.kD = glm::vec3(peak > 0 ? 1.0f : 0.0f);
    model.A = glm::vec3((peak > 0 ? peak : 1.0f) / f0);
    model.B = width;
    model.C = tail;
    model.ior = kLobeIor;
    return {fmt::format("built-in lobe of B {:g}, C {:g}, {}", width, tail,
                        peak > 0 ? fmt::format("{:g} x diffuse", peak) : "no diffuse part"),
            model};
}

std::string withoutNumber(std::string name)
{
    while (!name.empty() && std::isdigit(static_cast<unsigned char>(name.back()))) {
        name.pop_back();
    }
    return name;
}

void addFits(const std::string& family, const std::vector<NamedBrdf>& fits, const std::vector<std::string>& excluded,
             std::vector<NamedBrdf>& dictionary)
{
    for (const NamedBrdf& fit : fits) {
        const bool out = std::any_of(excluded.begin(), excluded.end(), [&](const std::string& name) {
            return withoutNumber(name) == withoutNumber(fit.name);
        });
        if (!out) {
            dictionary.push_back({family + ":" + fit.name, fit.model});
        }
    }
}

// Known reflectances to explain an object by. Built in: Lambert, and Lambert plus an ABC lobe over a grid of widths,
// tails and strengths, from matt to metal. `fitsFolder` (empty: none) adds the published fits, named merl-abc:NAME and
// merl-sgd:NAME. `excluded` leaves out published fits by NAME, in both families and with their numbered siblings
// (gold-paint takes gold-paint2 along).
std::vector<NamedBrdf> makeReflectanceDictionary(const std::filesystem::path& fitsFolder,
                                                 const std::vector<std::string>& excluded)
{
    std::vector<NamedBrdf> dictionary;
    dictionary.push_back({"Lambert", LambertGgx{glm::vec3(0.5f), glm::vec3(0), 0.5f}});
    for (const float width : kLobeWidths) {
        for (const float tail : kLobeTails) {
            for (const float peak : kLobePeaks) {
                dictionary.push_back(builtInLobe(width, tail, peak));
            }
        }
    }
    if (!fitsFolder.empty()) {
        addFits("merl-abc", loadAbcFits(fitsFolder / "merl_abc_params.csv"), excluded, dictionary);
        addFits("merl-sgd", loadSgdFits(fitsFolder / "merl_sgd_params.csv"), excluded, dictionary);
    }
    return dictionary;
}

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
    const std::vector<size_t> pixels = spreadPixels(sample.pixelCount(), kPixelsToChoose);
    FewPixels few{selectPixels(sample, pixels), {}, selectItems(starts, pixels)};
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
