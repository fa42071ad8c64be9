#include "acquisition/capture/observation_blocks.h"

#include <utility>

namespace nacre {

ObservationBlocks::ObservationBlocks(Capture capture, int threads, size_t byteBudget)
    : capture_(std::make_shared<const Capture>(std::move(capture))), threads_(threads), byteBudget_(byteBudget)
{
}

ObservationBlocks::ObservationBlocks(std::vector<Observations> blocks) : held_(std::move(blocks)) {}

const Observations* ObservationBlocks::next()
{
    if (!held_.empty() || !capture_) {
        const bool isAtEnd = place_ == held_.size();
        place_ = isAtEnd ? 0 : place_ + 1;
        return isAtEnd ? nullptr : &held_[place_ - 1];
    }
    if (!reader_) {
        reader_.emplace(*capture_, threads_, byteBudget_);
    }
    if (!reader_->next(block_)) {
        reader_.reset();
        return nullptr;
    }
    if (!lights_.empty()) {
        block_ = selectLights(block_, lights_);
    }
    if (end_) {
        nacre::clipAt(*end_, block_);
    }
    if (block_.pixels.size() < capture_->maskPixels) {
        return &block_;
    }
    reader_.reset();
    held_.push_back(std::move(block_));
    place_ = 1;
    return &held_.front();
}

void ObservationBlocks::keepLights(const std::vector<size_t>& lights)
{
    if (lights.size() == capture_->photographs.size()) {
        return;
    }
    lights_ = lights;
    for (Observations& block : held_) {
        block = selectLights(block, lights_);
    }
}

void ObservationBlocks::clipAt(const glm::vec3& end)
{
    end_ = end;
    for (Observations& block : held_) {
        nacre::clipAt(end, block);
    }
}

} // namespace nacre
