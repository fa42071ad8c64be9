#include "acquisition/brdf/model_ladder.h"

#include <algorithm>

#include "acquisition/brdf/model_candidates.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

std::optional<size_t> chosenStep(const std::vector<LadderStep>& steps, const LadderOptions& options)
{
    std::optional<size_t> best;
    for (size_t i = 0; i < steps.size(); ++i) {
        const bool fits = options.budgetBytes == 0 || steps[i].bytes <= options.budgetBytes;
        const bool good = options.toleranceDecibels <= 0 || steps[i].psnr >= options.toleranceDecibels;
        // By tolerance the first will do, since steps go by bytes; by budget alone the best.
        const bool better = !best || (options.toleranceDecibels <= 0 && steps[i].psnr > steps[*best].psnr);
        if (fits && good && better) {
            best = i;
        }
    }
    return best;
}

} // namespace

ModelLadder climbLadder(const ModelJudge& judge, const LadderOptions& options)
{
    ModelLadder ladder;
    if (judge.isEmpty()) {
        return ladder;
    }
    std::vector<CompactBrdf> candidates = candidateModels(judge);
    ladder.steps.resize(candidates.size());
    parallelFor(candidates.size(), 1, options.threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const ModelJudge::Verdict verdict = judge.judge(candidates[i]);
            ladder.steps[i] = {candidates[i], describe(candidates[i]), bytesOf(candidates[i]), verdict.psnr,
                               verdict.nanoseconds};
        }
    });
    std::stable_sort(ladder.steps.begin(), ladder.steps.end(),
                     [](const LadderStep& a, const LadderStep& b) { return a.bytes < b.bytes; });
    ladder.taken = chosenStep(ladder.steps, options);
    return ladder;
}

} // namespace nacre
