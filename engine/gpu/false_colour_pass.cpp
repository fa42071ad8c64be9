#include "engine/gpu/false_colour_pass.h"

#include <array>

#include "false_colour_frag.h"
#include "shared/layout.h"

namespace nacre {

FalseColourPass::FalseColourPass(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST))
{
}

void FalseColourPass::record(VkCommandBuffer commands, const PixelTextures& pixels, bool plain, Show show,
                             const FalseColourConstants& constants)
{
    static_assert(kConstantModulated == 0 && kConstantShow == 1);
    static constexpr std::array kBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                             ShaderBinding{kBindingAlbedo, kTextureInput}};
    const std::pair key{int{!plain}, static_cast<int>(show)};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        const std::array variant = {key.first, key.second};
        found = pipelines_
                    .emplace(key, Pipeline(context_, {.fragmentShader = false_colour_frag,
                                                      .constants = variant,
                                                      .bindings = kBindings,
                                                      .pushConstantBytes = sizeof(FalseColourConstants),
                                                      .targetFormat = kCodeFormat}))
                    .first;
    }
    const Texture& albedo = plain ? pixels.normals : pixels.albedo; // bound, but not read where plain
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                               textureInput(kBindingAlbedo, nearest_, albedo)};
    draw(context_, commands, found->second, inputs, bytesOf(constants));
}

} // namespace nacre
