#include "engine/gpu/residual_pass.h"

#include <array>

#include "residual_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array<uint8_t, kComponentsPerTexel> kNoCodes = {0};
constexpr std::array kBindings = {
    ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingResidual, kTextureInput}, ShaderBinding{kBindingResidualWeights, kUniformInput}};

} // namespace

ResidualPass::ResidualPass(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      weights_(context, sizeof(ResidualWeights), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT),
      noComponents_(uploadLayers(context, {1, 1, 1}, 1, kIntegersFormat, kNoCodes))
{
}

void ResidualPass::upload(const ResidualWeights& weights, float gain)
{
    auto& uploaded = *static_cast<ResidualWeights*>(weights_.mapped());
    uploaded.offset = gain * weights.offset;
    for (int k = 0; k < kMostResidualComponents; ++k) {
        uploaded.gains[k] = gain * weights.gains[k];
    }
}

ShaderInput ResidualPass::components(const PixelTextures& pixels) const
{
    const bool has = pixels.residual.bytes() > 0;
    return textureInput(kBindingResidual, nearest_, has ? pixels.residual : noComponents_);
}

ShaderInput ResidualPass::weights() const
{
    return uniformInput(kBindingResidualWeights, weights_, 0, sizeof(ResidualWeights));
}

void ResidualPass::record(VkCommandBuffer commands, const PixelTextures& pixels, int materials, int firstRow)
{
    static_assert(kConstantPackedNormals == 0 && kConstantResidualLayers == 1);
    const std::pair key{int{pixels.normals.format() == kPackedNormalFormat},
                        static_cast<int>(pixels.residual.layers())};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        const std::array constants = {key.first, key.second};
        found = pipelines_
                    .emplace(key, Pipeline(context_, {.fragmentShader = residual_frag,
                                                      .constants = constants,
                                                      .bindings = kBindings,
                                                      .pushConstantBytes = sizeof(ResidualConstants),
                                                      .targetFormat = kFloatFormat,
                                                      .blend = Blend::add}))
                    .first;
    }
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                               textureInput(kBindingAlbedo, nearest_, pixels.albedo), components(pixels), weights()};
    draw(context_, commands, found->second, inputs,
         bytesOf(ResidualConstants{.materials = materials, .firstRow = firstRow}));
}

} // namespace nacre
