#include "engine/gpu/zoom_frame.h"

#include <array>

#include <glm/common.hpp>

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

// The target's pixels that pixels of the picture have a share in.
VkRect2D ZoomFrame::reached(const VkRect2D& drawn) const
{
    if (zoom_.magnifies()) {
        return drawn;
    }
    const glm::vec2 first(drawn.offset.x, drawn.offset.y);
    const glm::vec2 size(drawn.extent.width, drawn.extent.height);
    const glm::vec2 most(zoom_.size); // a pixel more on each side: what is rounded is so in the shader, too
    const glm::vec2 low = glm::clamp(glm::floor((first - zoom_.origin) * zoom_.scale) - 1.0f, glm::vec2(0), most);
    const glm::vec2 high = glm::clamp(glm::ceil((first + size - zoom_.origin) * zoom_.scale) + 1.0f, low, most);
    return {.offset = {static_cast<int32_t>(low.x), static_cast<int32_t>(low.y)},
            .extent = {static_cast<uint32_t>(high.x - low.x), static_cast<uint32_t>(high.y - low.y)}};
}

void ZoomFrame::draw(const Texture& picture, const VkRect2D& drawn)
{
    const Pipeline& pipeline = pipelines_.with({zoom_.magnifies() ? 0 : reachOfReduced(zoom_.scale)});
    const std::array inputs = {textureInput(kBindingInput, nearest_, picture),
                               textureInput(kBindingCover, nearest_, cover_)};
    const VkRect2D part = reached(drawn);
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, picture.image(), kCopiedFrom, kSampled);
        imageBarrier(commands, codes_.image(), kDiscarded, kDrawnTo);
        beginRendering(commands, codes_, Load::clear);
        vkCmdSetScissor(commands, 0, 1, &part);
        nacre::draw(context_, commands, pipeline, inputs,
                    bytesOf(ZoomConstants{.origin = zoom_.origin, .scale = zoom_.scale}));
        vkCmdEndRendering(commands);
        imageBarrier(commands, codes_.image(), kDrawnTo, kCopiedFrom);
        imageBarrier(commands, picture.image(), kSampled, kCopiedFrom);
    });
}

} // namespace nacre
