#pragma once
#include <string>
#include <vector>

#include "engine/files/stopwatch.h"

namespace nacre {

struct StageTime {
    std::string stage;
    double seconds = 0; // wall clock
};

// Seconds of stages that run one after the other, in the order in which they first began.
class StageClock {
public:
    // Ends the stage before.
    void enter(const std::string& stage);
    std::vector<StageTime> finish();

private:
    void endStage();

    std::vector<StageTime> times_;
    std::string stage_; // empty: none
    Stopwatch watch_;
};

} // namespace nacre
