#pragma once
#include "engine/gpu/balls.h"

namespace nacre {

// The balls of a surface's materials at rest, and coarser ones for while lights move.
class LitBalls {
public:
    static constexpr BallSize kMovingSize{.radiance = 256, .display = 512}; // at most
    static constexpr int kMagnifiedDisplay = 1024, kMostMagnification = 4;

    LitBalls(const Context& context, DirectPass& direct, VkDeviceSize cacheBytes)
        : context_(context), rest_{BallCache(context, direct, cacheBytes)}, moving_{
                                                                                BallCache(context, direct, cacheBytes)}
    {
    }

    // Of balls that are drawn from at rest or while lights move; sizes of what is too sharp at rest are 0.
    static std::vector<BallSize> sizesWhile(bool lightsMove, std::vector<BallSize> sizes);
    // Of balls for pictures that are magnified: their texels are seen sooner.
    static std::vector<BallSize> sizesMagnified(std::vector<BallSize> sizes);

    struct Inputs {
        std::vector<BallSize> sizes;
        bool modulated;
        const MovingLights::Order& order;
        const Display& display;
        std::span<const TableTexture> tables;
        const LightGroups& groups; // of the order
    };
    // Draws what has changed.
    const BallCache& updated(bool lightsMove, const Inputs& inputs);
    // The materials are others, or what is done with their balls.
    void drop() { rest_.isStale = moving_.isStale = true; }

    VkDeviceSize bytes() const { return rest_.balls.bytes() + moving_.balls.bytes(); }
    size_t drawnLights() const { return rest_.balls.drawnLights() + moving_.balls.drawnLights(); }

private:
    struct Kept {
        BallCache balls;
        std::vector<BallSize> sizes{};
        bool isStale = true; // does not know the materials yet
    };
    const Context& context_;
    Kept rest_, moving_;
};

} // namespace nacre
