#pragma once
#include <map>

#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"

namespace nacre {

// Draws shaders/residual.frag: what a residual layer adds to radiance, under the weights that were uploaded last.
class ResidualPass {
public:
    explicit ResidualPass(const Context& context);

    // For the draws that are recorded and run next; `gain` multiplies them.
    void upload(const ResidualWeights& weights, float gain = 1);
    // Adds to the target, which has kFloatFormat and is being rendered to; its row 0 is the surface's firstRow.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, int materials, int firstRow);

    // What other shaders that include residual_input.glsl read. Bound but not read where the pixels have no layer.
    ShaderInput components(const PixelTextures& pixels) const;
    ShaderInput weights() const;
    VkDeviceSize bytes() const { return weights_.bytes(); }

private:
    const Context& context_;
    std::map<std::pair<int, int>, Pipeline> pipelines_; // by packed and layers
    Sampler nearest_;
    Buffer weights_;
    Texture noComponents_;
};

} // namespace nacre
