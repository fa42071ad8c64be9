#include "app/report/ladder_report.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace nacre {

std::string describe(const ModelLadder& ladder)
{
    if (ladder.steps.empty()) {
        return {};
    }
    std::string text = "model                                bytes   PSNR dB  ns a lookup\n";
    double best = -std::numeric_limits<double>::infinity();
    size_t others = 0;
    for (size_t i = 0; i < ladder.steps.size(); ++i) {
        const LadderStep& step = ladder.steps[i];
        const bool taken = ladder.taken == i;
        if (step.psnr <= best && !taken) {
            ++others;
            continue;
        }
        text += fmt::format("  {:<30} {:>9} {:>9.1f} {:>12.0f}{}\n", step.description, step.bytes, step.psnr,
                            step.nanoseconds, taken ? "  <- taken" : "");
        best = std::max(best, step.psnr);
    }
    return text + (others > 0 ? fmt::format("  {} others, no better than a smaller one\n", others) : "") +
           (ladder.taken ? "" : "  none of them is good enough: the full table stays\n");
}

} // namespace nacre
