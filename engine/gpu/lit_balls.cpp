#include "engine/gpu/lit_balls.h"

#include <algorithm>
#include <array>

namespace nacre {

std::vector<BallSize> LitBalls::sizesWhile(bool lightsMove, std::vector<BallSize> sizes)
{
    const auto coarse = [](int size, int most) { return size == 0 ? most : std::min(size, most); };
    for (BallSize& size : sizes) {
        if (lightsMove) {
            size = {coarse(size.radiance, kMovingSize.radiance), coarse(size.display, kMovingSize.display)};
        }
    }
    return sizes;
}

std::vector<BallSize> LitBalls::sizesMagnified(std::vector<BallSize> sizes)
{
    for (BallSize& size : sizes) {
        size.display = std::max(size.display, std::min(kMostMagnification * size.display, kMagnifiedDisplay));
    }
    return sizes;
}

const BallCache& LitBalls::updated(bool lightsMove, const Inputs& inputs)
{
    Kept& kept = lightsMove ? moving_ : rest_;
    if (kept.isStale || kept.sizes != inputs.sizes) {
        kept.balls.setMaterials(inputs.sizes, inputs.modulated);
        kept.sizes = inputs.sizes;
        kept.isStale = false;
    }
    kept.balls.setLights(inputs.order.lights, std::array{inputs.order.still, inputs.order.moved});
    kept.balls.setDisplay(inputs.display);
    if (kept.balls.prepare()) {
        context_.run([&](VkCommandBuffer commands) { kept.balls.record(commands, inputs.tables, inputs.groups); });
    }
    return kept.balls;
}

} // namespace nacre
