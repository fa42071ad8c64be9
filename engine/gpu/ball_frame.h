#pragma once
#include "engine/gpu/ball_cache.h"
#include "engine/gpu/fours_target.h"
#include "engine/gpu/residual_pass.h"

namespace nacre {

// Draws pictures from balls: one lookup a pixel, and what a residual layer adds to it.
class BallFrame {
public:
    explicit BallFrame(const Context& context);

    struct Inputs {
        const BallCache& balls; // modulated ones where the pixels have albedo factors or there is a layer
        int materials;
        int toneCurve;
        const ResidualPass& residual; // its weights know the exposure
        int residualFours;            // of components that are added, in fours
    };

    // Drops what was made for another surface.
    void reset() { target_.reset(); }
    // `codes` has kCodeFormat and the size of `pixels`; it is in kDrawnTo.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, const Texture& codes);

    VkDeviceSize bytes() const { return target_.bytes(); }

private:
    const Context& context_;
    Sampler nearest_;
    Pipelines pipelines_;
    FoursTarget target_;
};

} // namespace nacre
