#include "engine/gpu/residual_pass.h"

#include "residual_frag.h"

namespace nacre {

ResidualPass::ResidualPass(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      weights_(context, kFloatFormat, sizeof(ResidualWeights), Memory::shared),
      none_(context, kIntegersFormat, kComponentsPerTexel, Memory::device)
{
}

void ResidualPass::upload(const ResidualWeights& weights, float gain)
{
    static_assert(sizeof(ResidualWeights) == sizeof(glm::vec4) * (1 + kMostResidualComponents), "a texel each");
    auto& uploaded = *static_cast<ResidualWeights*>(weights_.buffer().mapped());
    uploaded.offset = gain * weights.offset;
    for (int k = 0; k < kMostResidualComponents; ++k) {
        uploaded.gains[k] = gain * weights.gains[k];
    }
}

std::array<ShaderInput, 2> ResidualPass::inputs(const PixelTextures& pixels) const
{
    return {texelInput(kBindingResidual, pixels.residualFours > 0 ? pixels.residual : none_),
            texelInput(kBindingResidualWeights, weights_)};
}

const Pipeline& ResidualPass::pipeline(const PixelTextures& pixels)
{
    static_assert(kConstantPackedNormals == 0 && kConstantResidualFours == 1 && kConstantResidualModulated == 2);
    static constexpr std::array kAllBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                                ShaderBinding{kBindingAlbedo, kTextureInput}, kBindings[0],
                                                kBindings[1]};
    const std::array key = {int{pixels.normals.format() == kPackedNormalFormat}, pixels.residualFours,
                            int{pixels.albedo.bytes() > 0}};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        found = pipelines_
                    .emplace(key, Pipeline(context_, {.fragmentShader = residual_frag,
                                                      .constants = key,
                                                      .bindings = kAllBindings,
                                                      .pushConstantBytes = sizeof(ResidualConstants),
                                                      .targetFormat = kFloatFormat,
                                                      .blend = Blend::add}))
                    .first;
    }
    return found->second;
}

void ResidualPass::record(VkCommandBuffer commands, const PixelTextures& pixels, int materials, int firstRow)
{
    const std::array<ShaderInput, 2> layer = inputs(pixels);
    const std::array all = {textureInput(kBindingNormals, nearest_, pixels.normals),
                            textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels)), layer[0], layer[1]};
    draw(context_, commands, pipeline(pixels), all,
         bytesOf(ResidualConstants{
             .materials = materials, .firstRow = firstRow, .width = static_cast<int>(pixels.normals.extent().width)}));
}

} // namespace nacre
