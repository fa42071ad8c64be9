// Which path a renderer's pictures take, and why.
#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/gpu/renderer.h"
#include "engine/surface/object_places.h"

namespace nacre {

const std::vector<BallSize>& Renderer::ballSizes()
{
    while (ballSizes_.size() < surface_.materials.size()) {
        ballSizes_.push_back(measuredBallSize(surface_.materials[ballSizes_.size()].table));
    }
    return ballSizes_;
}

std::vector<BallSize> Renderer::drawnBallSizes()
{
    if (lightsMove_ || !zoom_ || !zoom_->magnifies()) {
        return LitBalls::sizesWhile(lightsMove_, ballSizes());
    }
    const std::vector<BallSize> finer = LitBalls::sizesMagnified(ballSizes());
    return BallCache::leastBytes(finer, !ballsAreCodes(), lights_.size()) <= cacheBytes_ ? finer : ballSizes();
}

bool Renderer::isCoarse()
{
    return pathTaken() == RenderPath::ball && LitBalls::sizesWhile(lightsMove_, ballSizes()) != ballSizes();
}

std::string Renderer::whyDirect()
{
    if (show_ == Show::coverage) {
        return "coverage is looked up per pixel and light";
    }
    if (!isFromTheFront(view_)) {
        return "balls are for the view from the front";
    }
    if (surface_.materials.empty()) {
        return "there is no material";
    }
    if (viewpointOf(surface_, view_).w > 0) {
        return "the camera is near, and pixels of one normal see it from other sides";
    }
    if (anyIsNear(lights_)) {
        return "near lights differ between pixels of one normal";
    }
    if (!hasDevicePixels_ && !surface_.horizon.empty()) {
        return "cast shadows differ between pixels of one normal";
    }
    const std::vector<BallSize> sizes = LitBalls::sizesWhile(lightsMove_, ballSizes());
    for (size_t i = 0; i < sizes.size(); ++i) {
        if (sizes[i].radiance == 0) {
            return fmt::format("the highlight of '{}' is too sharp for a ball", surface_.materials[i].name);
        }
    }
    const VkDeviceSize bytes = BallCache::leastBytes(sizes, !ballsAreCodes(), lights_.size());
    if (bytes > cacheBytes_) {
        return fmt::format("the balls of {} material(s) take {} MiB, {} may be cached", surface_.materials.size(),
                           bytes >> 20, cacheBytes_ >> 20);
    }
    return {};
}

RenderPath Renderer::pathTaken()
{
    if (path_ == RenderPath::direct || show_ == Show::coverage) {
        return RenderPath::direct;
    }
    const std::string reason = whyDirect();
    if (path_ == RenderPath::ball && !reason.empty()) {
        throw Error("", "there is no ball for this: " + reason, "path auto or direct", Error::kUsage);
    }
    return reason.empty() ? RenderPath::ball : RenderPath::direct;
}

} // namespace nacre
