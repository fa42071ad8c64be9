#pragma once
#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"
#include "engine/scene/false_colour.h"

namespace nacre {

// Draws shaders/false_colour.frag: what shading starts from, in place of the picture.
class FalseColourFrame {
public:
    explicit FalseColourFrame(const Context& context);

    // `codes` has kCodeFormat and the size of `pixels`; it is in kDrawnTo.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, Show show, const FalseColourConstants& constants,
                const Texture& codes);

private:
    const Context& context_;
    Sampler nearest_;
    Pipelines pipelines_;
};

} // namespace nacre
