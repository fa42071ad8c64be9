#include "engine/gpu/zoom_frame.h"

#include <array>

#include "shared/layout.h"
#include "shared/zoom.h"
#include "zoom_frag.h"

namespace nacre {
namespace {

constexpr std::array kZoomBindings = {ShaderBinding{kBindingInput, kTextureInput},
                                      ShaderBinding{kBindingCover, kTextureInput}};
static_assert(kConstantReach == 0);

VkExtent3D extentOf(const Zoom& zoom)
{
    return {static_cast<uint32_t>(zoom.size.x), static_cast<uint32_t>(zoom.size.y), 1};
}

} // namespace

ZoomFrame::ZoomFrame(const Context& context)
    : context_(context), pipelines_(context, {.fragmentShader = zoom_frag,
                                              .bindings = kZoomBindings,
                                              .pushConstantBytes = sizeof(ZoomConstants),
                                              .targetFormat = kCodeFormat}),
      nearest_(makeSampler(context, VK_FILTER_NEAREST))
{
}

void ZoomFrame::set(const Zoom& zoom, std::span<const uint8_t> cover)
{
    if (codes_.bytes() == 0 || zoom.size != zoom_.size) {
        codes_ = makeTarget(context_, extentOf(zoom), kCodeFormat);
    }
    zoom_ = zoom;
    constexpr std::array<uint8_t, 1> kNone = {0};
    cover_ =
        cover.empty() ? uploadLayers(context_, {1, 1, 1}, 1, kNone) : uploadLayers(context_, extentOf(zoom), 1, cover);
}

void ZoomFrame::draw(const Texture& picture)
{
    const Pipeline& pipeline = pipelines_.with({zoom_.magnifies() ? 0 : reachOfReduced(zoom_.scale)});
    const std::array inputs = {textureInput(kBindingInput, nearest_, picture),
                               textureInput(kBindingCover, nearest_, cover_)};
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, picture.image(), kCopiedFrom, kSampled);
        imageBarrier(commands, codes_.image(), kDiscarded, kDrawnTo);
        beginRendering(commands, codes_, Load::clear);
        nacre::draw(context_, commands, pipeline, inputs,
                    bytesOf(ZoomConstants{.origin = zoom_.origin, .scale = zoom_.scale}));
        vkCmdEndRendering(commands);
        imageBarrier(commands, codes_.image(), kDrawnTo, kCopiedFrom);
        imageBarrier(commands, picture.image(), kSampled, kCopiedFrom);
    });
}

} // namespace nacre
