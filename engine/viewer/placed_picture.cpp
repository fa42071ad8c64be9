#include "engine/viewer/placed_picture.h"

#include <cmath>

#include <glm/common.hpp>

#include "engine/gpu/buffer.h"

namespace nacre {
namespace {

constexpr ImageUse kFilled{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                           VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr VkImageSubresourceLayers kLayer{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};

// Texel by texel, which is several times as quick as a blit.
void recordCopy(VkCommandBuffer commands, const Texture& window, const Texture& texture, const BlitRegion& region)
{
    const glm::ivec2 size = region.fromEnd - region.from;
    const VkImageCopy copy{.srcSubresource = kLayer,
                           .srcOffset = {region.from.x, region.from.y, 0},
                           .dstSubresource = kLayer,
                           .dstOffset = {region.to.x, region.to.y, 0},
                           .extent = {static_cast<uint32_t>(size.x), static_cast<uint32_t>(size.y), 1}};
    vkCmdCopyImage(commands, texture.image(), kCopiedFrom.layout, window.image(), kFilled.layout, 1, &copy);
}

void recordPicture(VkCommandBuffer commands, const Texture& window, const PlacedPicture& picture)
{
    const VkExtent3D extent = picture.texture->extent();
    std::vector<VkImageBlit> blits;
    for (const BlitRegion& r : blitRegions({extent.width, extent.height}, picture.firstColumn, picture.endColumn,
                                           picture.framing, picture.area)) {
        if (window.format() == picture.texture->format() && r.toEnd - r.to == r.fromEnd - r.from) {
            recordCopy(commands, window, *picture.texture, r);
            continue;
        }
        blits.push_back({.srcSubresource = kLayer,
                         .srcOffsets = {{r.from.x, r.from.y, 0}, {r.fromEnd.x, r.fromEnd.y, 1}},
                         .dstSubresource = kLayer,
                         .dstOffsets = {{r.to.x, r.to.y, 0}, {r.toEnd.x, r.toEnd.y, 1}}});
    }
    if (!blits.empty()) {
        // Photographs and verdicts, magnified: single pixels stay what they are.
        const VkFilter filter = picture.framing.zoom >= 1 ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
        vkCmdBlitImage(commands, picture.texture->image(), kCopiedFrom.layout, window.image(), kFilled.layout,
                       static_cast<uint32_t>(blits.size()), blits.data(), filter);
    }
}

} // namespace

Texture uploadPicture(const Context& context, const Image& codes)
{
    const VkExtent3D extent{static_cast<uint32_t>(codes.width), static_cast<uint32_t>(codes.height), 1};
    Texture texture(context, {.extent = extent,
                              .format = kCodeFormat,
                              .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                       VK_IMAGE_USAGE_SAMPLED_BIT}); // its view needs one that is read or drawn
    const Buffer staging(context, 4 * codes.pixelCount(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    auto* bytes = static_cast<uint8_t*>(staging.mapped());
    for (size_t i = 0; i < codes.pixelCount(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            bytes[4 * i + 2 - c] = static_cast<uint8_t>(std::lround(255 * codes.values[3 * i + c]));
        }
        bytes[4 * i + 3] = 255;
    }
    context.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, texture.image(), kUnused, kCopiedTo);
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = extent};
        vkCmdCopyBufferToImage(commands, staging.get(), texture.image(), kCopiedTo.layout, 1, &copy);
        imageBarrier(commands, texture.image(), kCopiedTo, kCopiedFrom);
    });
    return texture;
}

PlacedPicture placedPicture(const Texture& texture, const Area& place, const Area& area)
{
    const auto width = static_cast<float>(texture.extent().width), height = static_cast<float>(texture.extent().height);
    const float zoom = place.size.x / width;
    const glm::vec2 centre = glm::vec2(width, height) / 2.0f + (area.middle() - place.middle()) / zoom;
    return {.texture = &texture,
            .endColumn = static_cast<int>(texture.extent().width),
            .framing = {.zoom = zoom, .centre = centre},
            .area = area};
}

PixelBox boxOf(const PlacedPicture& picture)
{
    const VkExtent3D extent = picture.texture->extent();
    PixelBox box;
    for (const BlitRegion& r : blitRegions({extent.width, extent.height}, picture.firstColumn, picture.endColumn,
                                           picture.framing, picture.area)) {
        box = box.isEmpty() ? PixelBox{r.to, r.toEnd} : PixelBox{glm::min(box.low, r.to), glm::max(box.high, r.toEnd)};
    }
    return box;
}

void recordPictures(VkCommandBuffer commands, const Texture& target, std::span<const PlacedPicture> pictures)
{
    imageBarrier(commands, target.image(), kDrawnTo, kFilled);
    for (const PlacedPicture& picture : pictures) {
        imageBarrier(commands, target.image(), kFilled, kFilled); // one after the other
        recordPicture(commands, target, picture);
    }
    imageBarrier(commands, target.image(), kFilled, kDrawnTo);
}

} // namespace nacre
