#include "evaluation/charts/budget_search.h"

#include <algorithm>

#include "engine/files/error.h"

namespace nacre {

namespace {

struct OutOfTime {};

// What an acquisition took: stages that charts time, and all else (reading, lights, albedo), which grows with the
// photographs.
struct SearchCost {
    double charted = 0, other = 0; // seconds
    double photographs = 1;
};

SearchCost costOf(const Acquisition& acquisition, double seconds)
{
    SearchCost cost;
    for (const StageTime& time : acquisition.estimate.times) {
        cost.charted +=
            time.stage == "choosing" || time.stage == "normals" || time.stage == "baking" ? time.seconds : 0;
    }
    cost.other = std::max(0.0, seconds - cost.charted);
    cost.photographs = static_cast<double>(acquisition.estimate.given.size());
    return cost;
}

class Search {
public:
    Search(const Capture& capture, const AcquireOptions& options, double budget, const std::function<double()>& elapsed,
           const Progress& progress)
        : capture_(capture), options_(options), budget_(budget), elapsed_(elapsed), progress_(progress)
    {
        heldOut_ = heldOutIndices(capture.photographs.size(), {.heldOutEvery = kBudgetHeldOutEvery}).size();
    }

    BudgetResult run(std::vector<AcquireCandidate> candidates)
    {
        keepPossible(candidates);
        acquireWholly(candidates.front());
        result_.untried = candidates.size();
        if (given() < kFewestLightsGiven) {
            result_.comment = "too few photographs to hold one out: the quickest candidate is kept unjudged";
        } else if (elapsed_() + expected(candidates.front(), given()) > budget_) {
            result_.comment = "the time is too short to judge any: the quickest candidate is kept";
        } else {
            judgeAll(candidates);
        }
        result_.seconds = elapsed_();
        return std::move(result_);
    }

private:
    size_t given() const { return capture_.photographs.size() - heldOut_; }

    void keepPossible(std::vector<AcquireCandidate>& candidates) const
    {
        std::erase_if(candidates, [&](const AcquireCandidate& c) { return c.lightsGiven >= given(); });
        if (candidates.empty()) {
            candidates.emplace_back();
        }
    }

    // Without a judge: what is kept.
    void acquireWholly(const AcquireCandidate& candidate)
    {
        const double start = elapsed_();
        result_.options = optionsOf(candidate, options_);
        result_.acquisition = acquire(capture_, result_.options, progress_);
        result_.kept = candidate;
        last_ = costOf(result_.acquisition, elapsed_() - start);
        lastSeconds_ = candidate.seconds;
    }

    // Seconds of an acquisition, by ratios to the last one.
    double expected(const AcquireCandidate& candidate, size_t photographs) const
    {
        const double used = static_cast<double>(candidate.lightsGiven > 0 ? candidate.lightsGiven : photographs);
        return last_.charted * candidate.seconds / lastSeconds_ + last_.other * used / last_.photographs;
    }

    void judgeAll(const std::vector<AcquireCandidate>& candidates)
    {
        const JudgingPhotographs judging = readJudging(capture_, options_, kBudgetHeldOutEvery);
        result_.judges = heldOut_;
        size_t best = 0;
        std::optional<double> bestPsnr;
        for (size_t i = 0; i < candidates.size(); ++i) {
            // The quickest one is acquired already.
            const double finalSeconds = i > 0 ? expected(candidates[i], capture_.photographs.size()) : 0;
            if (elapsed_() + expected(candidates[i], given()) + finalSeconds > budget_) {
                break;
            }
            const double reserve = best > 0 ? expected(candidates[best], capture_.photographs.size()) : 0;
            const BudgetTrial& trial = result_.trials.emplace_back(judged(candidates[i], judging, reserve));
            --result_.untried;
            if (trial.psnr && (!bestPsnr || *trial.psnr > *bestPsnr)) {
                best = i;
                bestPsnr = trial.psnr;
            }
        }
        if (best > 0) {
            acquireWholly(candidates[best]);
        }
    }

    // Ends when no more than `reserve` seconds are left.
    BudgetTrial judged(const AcquireCandidate& candidate, const JudgingPhotographs& judging, double reserve)
    {
        AcquireOptions options = optionsOf(candidate, options_);
        options.lights.heldOutEvery = kBudgetHeldOutEvery;
        options.keepVerdicts = false;
        options.ladder.toleranceDecibels = 0;
        options.ladder.budgetBytes = 0;
        const double start = elapsed_();
        BudgetTrial trial{candidate, 0, {}, {}};
        try {
            const Acquisition acquisition = acquire(capture_, options, [&](const std::string& stage, double share) {
                if (elapsed_() + reserve > budget_) {
                    throw OutOfTime();
                }
                progress_(stage, share);
            });
            trial.psnr = psnrOf(acquisition.surface, judging, options.normals.threads);
            last_ = costOf(acquisition, elapsed_() - start);
            lastSeconds_ = candidate.seconds;
        } catch (const OutOfTime&) {
            trial.refusal = "the time was over";
        } catch (const Error& error) {
            trial.refusal = error.what();
        }
        trial.seconds = elapsed_() - start;
        return trial;
    }

    const Capture& capture_;
    const AcquireOptions& options_;
    double budget_; // seconds
    const std::function<double()>& elapsed_;
    const Progress& progress_;
    size_t heldOut_ = 0;
    SearchCost last_;
    double lastSeconds_ = 1; // the chart's, of the last candidate
    BudgetResult result_;
};

} // namespace

BudgetResult acquireWithin(const Capture& capture, const AcquireOptions& options,
                           const std::vector<AcquireCandidate>& candidates, double budgetSeconds,
                           const std::function<double()>& elapsed, const Progress& progress)
{
    return Search(capture, options, budgetSeconds, elapsed, progress).run(candidates);
}

} // namespace nacre
