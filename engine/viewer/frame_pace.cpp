#include "engine/viewer/frame_pace.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace nacre {

void FramePace::ask(int frames)
{
    left_ = std::max(left_, frames);
}

void FramePace::wait() const
{
    const double seconds = due_ - clock_.seconds();
    if (isDue() && seconds > 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    }
}

void FramePace::begin()
{
    constexpr double kPeriod = 1 / kMostFramesPerSecond;
    due_ = std::max(due_, clock_.seconds() - kPeriod) + kPeriod; // what comes a little late does not delay the next
    sinceBegin_.lap();
    --left_;
}

void FramePace::end()
{
    const double seconds = sinceBegin_.seconds();
    seconds_ = seconds_ > 0 ? 0.8 * seconds_ + 0.2 * seconds : seconds;
    ++drawn_;
}

} // namespace nacre
