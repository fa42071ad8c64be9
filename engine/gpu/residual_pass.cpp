#include "engine/gpu/residual_pass.h"

#include "residual_frag.h"

namespace nacre {

namespace {

constexpr std::array kResidualBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                          ShaderBinding{kBindingAlbedo, kTextureInput}, ResidualPass::kBindings[0],
                                          ResidualPass::kBindings[1]};
static_assert(kConstantPackedNormals == 0 && kConstantResidualFours == 1 && kConstantResidualModulated == 2);

} // namespace

ResidualPass::ResidualPass(const Context& context)
    : context_(context), pipelines_(context, {.fragmentShader = residual_frag,
                                              .bindings = kResidualBindings,
                                              .pushConstantBytes = sizeof(ResidualConstants),
                                              .targetFormat = kFloatFormat,
                                              .blend = Blend::add}),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)),
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

void ResidualPass::record(VkCommandBuffer commands, const PixelTextures& pixels, int materials, int firstRow)
{
    const std::array<ShaderInput, 2> layer = inputs(pixels);
    const std::array all = {textureInput(kBindingNormals, nearest_, pixels.normals),
                            textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels)), layer[0], layer[1]};
    const Pipeline& pipeline = pipelines_.with(
        {pixels.normals.format() == kPackedNormalFormat, pixels.residualFours, pixels.albedo.bytes() > 0});
    draw(context_, commands, pipeline, all,
         bytesOf(ResidualConstants{
             .materials = materials, .firstRow = firstRow, .width = static_cast<int>(pixels.normals.extent().width)}));
}

} // namespace nacre
