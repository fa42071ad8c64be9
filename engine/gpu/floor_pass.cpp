#include "engine/gpu/floor_pass.h"

#include <array>

#include "floor_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

Pipeline floorPipeline(const Context& context, bool plain)
{
    static constexpr std::array kBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                             ShaderBinding{kBindingAlbedo, kTextureInput}};
    static_assert(kConstantModulated == 0);
    const std::array constants = {int{!plain}};
    return Pipeline(
        context,
        {.fragmentShader = floor_frag, .constants = constants, .bindings = kBindings, .targetFormat = kCodeFormat});
}

} // namespace

FloorPass::FloorPass(const Context& context, const Surface& surface)
    : context_(context), plain_(isPlain(surface)), pixels_(uploadPixels(context, surface, plain_, Precision::compact)),
      target_(makeTarget(context, pixels_.normals.extent(), kCodeFormat)),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)), pipeline_(floorPipeline(context, plain_))
{
}

void FloorPass::draw()
{
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels_.normals),
                               textureInput(kBindingAlbedo, nearest_, plain_ ? pixels_.normals : pixels_.albedo)};
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, target_.image(), kDiscarded, kDrawnTo);
        beginRendering(commands, target_, Load::clear);
        nacre::draw(context_, commands, pipeline_, inputs, {});
        vkCmdEndRendering(commands);
        imageBarrier(commands, target_.image(), kDrawnTo, kCopiedFrom);
    });
}

} // namespace nacre
