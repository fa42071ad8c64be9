#pragma once
#include <chrono>
#include <utility>

namespace nacre {

// Wall-clock seconds since it was made, or since the last lap.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    double lap()
    {
        const auto before = std::exchange(start_, Clock::now());
        return std::chrono::duration<double>(start_ - before).count();
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

template <class Work> double secondsOf(Work&& work)
{
    const Stopwatch watch;
    work();
    return watch.seconds();
}

} // namespace nacre
