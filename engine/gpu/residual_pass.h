#pragma once
#include <array>

#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"
#include "shared/layout.h"

namespace nacre {

// Draws shaders/residual.frag: what a residual layer adds to radiance, under the weights that were uploaded last.
class ResidualPass {
public:
    explicit ResidualPass(const Context& context);

    // For the draws that are recorded and run next; `gain` multiplies them.
    void upload(const ResidualWeights& weights, float gain = 1);
    // Adds to the target, which has kFloatFormat and is being rendered to; its row 0 is the surface's firstRow.
    void record(VkCommandBuffer commands, const PixelTextures& pixels, int materials, int firstRow);

    // What shaders that include residual_input.glsl read; a stand-in for the layer where the pixels have none.
    static constexpr std::array kBindings = {ShaderBinding{kBindingResidual, kTexelInput},
                                             ShaderBinding{kBindingResidualWeights, kTexelInput}};
    std::array<ShaderInput, 2> inputs(const PixelTextures& pixels) const;

    VkDeviceSize bytes() const { return weights_.bytes() + none_.bytes(); }

private:
    const Context& context_;
    Pipelines pipelines_;
    Sampler nearest_;
    TexelBuffer weights_;
    TexelBuffer none_; // one texel, in place of components
};

} // namespace nacre
