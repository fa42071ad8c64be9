#pragma once
#include <map>

#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"
#include "engine/scene/false_colour.h"

namespace nacre {

// Draws shaders/false_colour.frag: normals, labels or coordinates as colours.
class FalseColourPass {
public:
    explicit FalseColourPass(const Context& context);

    // The target has kCodeFormat and is being rendered to; the pixels are compact ones.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, bool plain, Show show,
                const FalseColourConstants& constants);

private:
    const Context& context_;
    Sampler nearest_;
    std::map<std::pair<int, int>, Pipeline> pipelines_; // by modulated and show
};

} // namespace nacre
