#include "engine/gpu/false_colour_frame.h"

#include <array>

#include "false_colour_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array kFalseColourBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                             ShaderBinding{kBindingAlbedo, kTextureInput}};
static_assert(kConstantModulated == 0 && kConstantShow == 1);

} // namespace

FalseColourFrame::FalseColourFrame(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      pipelines_(context, {.fragmentShader = false_colour_frag,
                           .bindings = kFalseColourBindings,
                           .pushConstantBytes = sizeof(FalseColourConstants),
                           .targetFormat = kCodeFormat})
{
}

void FalseColourFrame::record(VkCommandBuffer commands, const PixelTextures& pixels, Show show,
                              const FalseColourConstants& constants, const Texture& codes)
{
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                               textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels))};
    const Pipeline& pipeline = pipelines_.with({pixels.albedo.bytes() > 0, static_cast<int>(show)});
    beginRendering(commands, codes, Load::clear);
    draw(context_, commands, pipeline, inputs, bytesOf(constants));
    vkCmdEndRendering(commands);
}

} // namespace nacre
