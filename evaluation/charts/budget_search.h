#pragma once
#include <functional>
#include <optional>

#include "evaluation/charts/candidate_order.h"
#include "evaluation/held_out/judging_photographs.h"

namespace nacre {

// Every seventh photograph judges candidates, as in charts.
constexpr size_t kBudgetHeldOutEvery = 7;

struct BudgetTrial {
    AcquireCandidate candidate;
    double seconds = 0;         // wall clock
    std::optional<double> psnr; // dB of held-out photographs; empty: the time was over, or it was refused
    std::string refusal;        // what the program said in place of a result
};

struct BudgetResult {
    Acquisition acquisition; // of all photographs that the kept candidate wants, none held out
    AcquireOptions options;  // that made it: the same as given by hand, and the same bytes
    AcquireCandidate kept;
    std::vector<BudgetTrial> trials;
    size_t untried = 0;  // candidates that the time had no room for
    size_t judges = 0;   // photographs held out
    double seconds = 0;  // of all
    std::string comment; // where nothing was judged, why
};

// The quickest candidate's surface first, so that there is one. Then candidates in their order, each acquired from the
// photographs that are not held out and judged by those that are, as long as the next one and its final acquisition
// are expected to fit; then the final acquisition of the best, where that is another than the quickest. How many are
// tried depends on the machine; the surface on the kept candidate alone.
// `elapsed`: seconds since the start. Candidates that the capture has not the photographs for are left out.
BudgetResult acquireWithin(const Capture& capture, const AcquireOptions& options,
                           const std::vector<AcquireCandidate>& candidates, double budgetSeconds,
                           const std::function<double()>& elapsed, const Progress& progress);

} // namespace nacre
