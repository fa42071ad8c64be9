#include "acquisition/exemplar_reestimation.h"

#include <optional>

#include <fmt/format.h>

#include "acquisition/object_exemplar.h"

namespace nacre {

namespace {

constexpr int kMostRounds = 3;
constexpr size_t kHoldOutEvery = 6;
constexpr size_t kFewestKeptLights = 6;
// A round has to lower the held-out cost to this share of the round before.
constexpr double kLeastGain = 0.98;
// The holds-out pattern: every sixth light, the padding left out.
void splitLights(size_t count, std::vector<float>& kept, std::vector<float>& heldOut)
{
    kept = heldOut = allLights(count);
    for (size_t i = 0; i < count; ++i) {
        (i % kHoldOutEvery == kHoldOutEvery / 2 ? kept : heldOut)[i] = 0;
    }
}

} // namespace

void reestimate(ExemplarModel& model, const Intensities& sample, const std::vector<glm::vec3>& starts,
                const std::vector<Light>& lights, int threads, std::vector<std::string>& remarks)
{
    std::vector<float> kept, heldOut;
    splitLights(lights.size(), kept, heldOut);
    if (countOf(kept) < kFewestKeptLights || countOf(heldOut) < 1) {
        return;
    }
    // How many rounds pay, found out without the held-out lights.
    ExemplarModel trial = model;
    ExemplarResult result = matchBlock(trial, sample, starts, kept, threads);
    double cost = predictionCost(lastExemplar(trial), sample, result, heldOut);
    const double first = cost;
    int rounds = 0;
    for (; rounds < kMostRounds; ++rounds) {
        const Exemplar& last = lastExemplar(trial);
        std::optional<Exemplar> own =
            makeObjectExemplar(sample, result, judgeByExemplar(last, sample, result, threads), lights, kept, threads);
        if (!own) {
            break;
        }
        trial.reestimated.push_back(std::move(*own));
        refineBlock(lastExemplar(trial), sample, kept, threads, result);
        const double next = predictionCost(lastExemplar(trial), sample, result, heldOut);
        if (!(next < kLeastGain * cost)) {
            break;
        }
        cost = next;
    }
    remarks.push_back(
        fmt::format("re-estimated {} time(s) with the object's own BRDF: error on {} held-out lights {:.4f} -> {:.4f}",
                    rounds, countOf(heldOut), first, cost));
    // The same number of rounds with every light.
    const std::vector<float> all = allLights(lights.size());
    for (int round = 0; round < rounds; ++round) {
        if (round == 0) {
            result = matchBlock(model, sample, starts, all, threads);
        } else {
            refineBlock(lastExemplar(model), sample, all, threads, result);
        }
        const Exemplar& last = lastExemplar(model);
        model.reestimated.push_back(
            *makeObjectExemplar(sample, result, judgeByExemplar(last, sample, result, threads), lights, all, threads));
    }
}

} // namespace nacre
