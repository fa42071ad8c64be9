#pragma once
#include <functional>
#include <string>

#include "acquisition/capture/observation_blocks.h"
#include "acquisition/chain/stage_clock.h"

namespace nacre {

// Called with the stage's name and its finished share in [0, 1].
using Progress = std::function<void(const std::string&, double)>;

// One walk over all blocks for a stage; reading is a stage of its own on the clock.
class BlockWalk {
public:
    BlockWalk(ObservationBlocks& blocks, StageClock& clock, const Progress& progress, std::string stage);

    // The next block, with the stage entered; null at the end.
    const Observations* next();

private:
    ObservationBlocks& blocks_;
    StageClock& clock_;
    const Progress& progress_;
    std::string stage_;
    size_t pixels_ = 0; // seen
};

} // namespace nacre
