#include "acquisition/chain/block_walk.h"

#include <utility>

namespace nacre {

BlockWalk::BlockWalk(ObservationBlocks& blocks, StageClock& clock, const Progress& progress, std::string stage)
    : blocks_(blocks), clock_(clock), progress_(progress), stage_(std::move(stage))
{
}

const Observations* BlockWalk::next()
{
    progress_(stage_, static_cast<double>(pixels_) / static_cast<double>(blocks_.capture().maskPixels));
    clock_.enter("reading");
    const Observations* block = blocks_.next();
    clock_.enter(stage_);
    pixels_ += block ? block->pixels.size() : 0;
    return block;
}

} // namespace nacre
