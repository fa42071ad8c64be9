#pragma once
#include <cstddef>

#include "engine/files/stopwatch.h"

namespace nacre {

// How many frames are still to be drawn, when the next one is, and how long they take.
class FramePace {
public:
    static constexpr double kMostFramesPerSecond = 60; // FIFO does not hold every driver back

    void ask(int frames);             // at least so many
    void settle() { ask(kToSettle); } // something has happened
    bool isDue() const { return left_ > 0; }
    void wait() const; // until the next frame that is due
    void begin();
    void end();

    size_t drawn() const { return drawn_; }
    double seconds() const { return seconds_; } // of one, smoothed
    double sinceFrame() const { return sinceBegin_.seconds(); }

private:
    static constexpr int kToSettle = 3; // ImGui takes a few

    int left_ = kToSettle;
    Stopwatch clock_;
    double due_ = 0;       // on it: when the next frame is
    Stopwatch sinceBegin_; // of the frame that was drawn last
    double seconds_ = 0;
    size_t drawn_ = 0;
};

} // namespace nacre
