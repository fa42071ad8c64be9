#include "app/report/ladder_report.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace nacre {

namespace {

// Rows of a ladder by bytes: those that are no better than a smaller one are only counted.
class LadderRows {
public:
    void add(double psnr, bool taken, const std::string& row)
    {
        if (psnr > best_ || taken) {
            text_ += row + (taken ? "  <- taken\n" : "\n");
            best_ = std::max(best_, psnr);
        } else {
            ++others_;
        }
    }
    std::string text() const
    {
        return text_ + (others_ > 0 ? fmt::format("  {} others, no better than a smaller one\n", others_) : "");
    }

private:
    std::string text_;
    double best_ = -std::numeric_limits<double>::infinity();
    size_t others_ = 0;
};

} // namespace

std::string describe(const ModelLadder& ladder)
{
    if (ladder.steps.empty()) {
        return {};
    }
    LadderRows rows;
    for (size_t i = 0; i < ladder.steps.size(); ++i) {
        const LadderStep& step = ladder.steps[i];
        rows.add(step.psnr, ladder.taken == i,
                 fmt::format("  {:<30} {:>9} {:>9.1f} {:>12.0f}", step.description, step.bytes, step.psnr,
                             step.nanoseconds));
    }
    return "model                                bytes   PSNR dB  ns a lookup\n" + rows.text() +
           (ladder.taken ? "" : "  none of them is good enough: the full table stays\n");
}

std::string describe(const SharedLadder& ladder)
{
    if (ladder.steps.empty()) {
        return {};
    }
    const auto row = [](const SharedStep& step) {
        return fmt::format("  {:<30} {:>9} {:>9.1f}", step.description, step.bytes, step.leastPsnr);
    };
    LadderRows rows;
    for (size_t i = 0; i < ladder.steps.size(); ++i) {
        rows.add(ladder.steps[i].leastPsnr, ladder.taken == i, row(ladder.steps[i]));
    }
    return "all materials together               bytes  worst dB\n" + rows.text() + row(ladder.apart) +
           (ladder.taken ? "\n" : "  <- taken\n");
}

} // namespace nacre
