#include "engine/gpu/floor_pass.h"

#include <array>

#include "floor_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

Pipeline floorPipeline(const Context& context, bool plain)
{
    static constexpr std::array kFloorBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                                  ShaderBinding{kBindingAlbedo, kTextureInput}};
    static_assert(kConstantModulated == 0);
    const std::array constants = {int{!plain}};
    return Pipeline(context, {.fragmentShader = floor_frag,
                              .constants = constants,
                              .bindings = kFloorBindings,
                              .pushConstantBytes = sizeof(FloorConstants),
                              .targetFormat = kIntegersFormat});
}

} // namespace

FloorPass::FloorPass(const Context& context, const Surface& surface)
    : context_(context), plain_(isPlain(surface)), pixels_(uploadPixels(context, surface, plain_, Precision::compact)),
      codes_(makeTarget(context, pixels_.normals.extent(), kCodeFormat)), target_(context),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)), pipeline_(floorPipeline(context, plain_))
{
}

void FloorPass::draw()
{
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels_.normals),
                               textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels_))};
    const VkRect2D whole{.offset = {}, .extent = {codes_.extent().width, codes_.extent().height}};
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, codes_.image(), kDiscarded, kDrawnTo);
        target_.record(commands, codes_, whole, [&](int firstRow) {
            nacre::draw(
                context_, commands, pipeline_, inputs,
                bytesOf(FloorConstants{.firstRow = firstRow, .width = static_cast<int>(codes_.extent().width)}));
        });
        imageBarrier(commands, codes_.image(), kDrawnTo, kCopiedFrom);
    });
}

} // namespace nacre
