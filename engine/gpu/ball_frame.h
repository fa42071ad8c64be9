#pragma once
#include "engine/gpu/balls.h"
#include "engine/gpu/fours_target.h"
#include "engine/gpu/residual_pass.h"

namespace nacre {

// Draws pictures from balls: one lookup a pixel, and what a residual layer adds to it. Where each pixel looks is kept.
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

    // Drops what was made of other pixels.
    void dropPixels() { placesAreStale_ = true; }
    // Drops what was made for a picture of another size.
    void reset();
    // `codes` has kCodeFormat and the size of `pixels`, which are the same from one dropPixels to the next; it is in
    // kDrawnTo. Of its pixels only those of pixels.shown, and black ones beside them, are drawn.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, const Texture& codes);

    VkDeviceSize bytes() const { return target_.bytes() + places_.bytes(); }

private:
    // What places depend on beside the pixels.
    struct Layout {
        int size = 0; // texels across one ball
        int columns = 0;
        int materials = 0;
        bool operator==(const Layout&) const = default;
    };
    void recordPlaces(VkCommandBuffer commands, const PixelTextures& pixels, const Layout& layout);

    const Context& context_;
    Sampler nearest_;
    Pipelines placing_;
    Pipelines pipelines_;
    FoursTarget target_;
    Texture places_; // kPixelsPerTexel side by side in a texel
    Layout layout_;  // of places_
    bool placesAreStale_ = true;
};

} // namespace nacre
