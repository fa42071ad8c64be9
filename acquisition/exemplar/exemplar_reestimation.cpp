#include "acquisition/exemplar/exemplar_reestimation.h"

#include <optional>

#include <fmt/format.h>

#include "acquisition/exemplar/object_exemplar.h"

namespace nacre {

namespace {

constexpr int kMostRounds = 3;
constexpr size_t kFewestKeptLights = 6;
// A round has to lower the held-out cost to this share of the round before.
constexpr double kLeastGain = 0.98;
// Weights of the lights that are kept and of those held out; the padding is in neither.
void splitLights(size_t count, std::vector<float>& kept, std::vector<float>& heldOut)
{
    kept = heldOut = allLights(count);
    for (size_t i = 0; i < count; ++i) {
        (isHeldOut(i) ? kept : heldOut)[i] = 0;
    }
}

// False where no observation is left to bake the object's own BRDF from.
bool addRound(ExemplarModel& model, const Intensities& sample, const ExemplarResult& result,
              const std::vector<Light>& lights, const std::vector<float>& weights, int threads)
{
    const std::vector<Verdict> verdicts = judgeByExemplar(lastExemplar(model), sample, result, threads);
    const std::optional<BrdfTable> own = makeObjectTable(sample, result, verdicts, lights, weights, threads);
    if (own) {
        model.reestimated.push_back(makeObjectExemplar(*own, lights, threads));
    }
    return own.has_value();
}

} // namespace

void reestimate(ExemplarModel& model, const Intensities& sample, const std::vector<glm::vec3>& starts,
                const std::vector<Light>& lights, int threads, std::vector<Finding>& findings)
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
        if (!addRound(trial, sample, result, lights, kept, threads)) {
            break;
        }
        refineBlock(lastExemplar(trial), sample, kept, threads, result);
        const double next = predictionCost(lastExemplar(trial), sample, result, heldOut);
        if (!(next < kLeastGain * cost)) {
            break;
        }
        cost = next;
    }
    if (rounds > 0) {
        findings.push_back(
            {FindingCode::reflectanceMeasured,
             fmt::format(
                 "re-estimated {} time(s) with the object's own BRDF: error on {} held-out lights {:.4f} -> {:.4f}",
                 rounds, countOf(heldOut), first, cost)});
    }
    // The same number of rounds with every light.
    const std::vector<float> all = allLights(lights.size());
    for (int round = 0; round < rounds; ++round) {
        if (round == 0) {
            result = matchBlock(model, sample, starts, all, threads);
        } else {
            refineBlock(lastExemplar(model), sample, all, threads, result);
        }
        addRound(model, sample, result, lights, all, threads);
    }
}

} // namespace nacre
