#include "acquisition/chain/stage_clock.h"

#include <algorithm>
#include <utility>

namespace nacre {

void StageClock::enter(const std::string& stage)
{
    endStage();
    stage_ = stage;
    watch_.lap();
}

std::vector<StageTime> StageClock::finish()
{
    endStage();
    stage_.clear();
    return std::move(times_);
}

void StageClock::endStage()
{
    if (stage_.empty()) {
        return;
    }
    const double seconds = watch_.seconds();
    const auto found =
        std::find_if(times_.begin(), times_.end(), [&](const StageTime& t) { return t.stage == stage_; });
    (found == times_.end() ? times_.emplace_back(StageTime{stage_, 0}) : *found).seconds += seconds;
}

} // namespace nacre
