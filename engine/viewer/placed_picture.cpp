#include "engine/viewer/placed_picture.h"

namespace nacre {

namespace {

constexpr ImageUse kAcquired{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};
constexpr ImageUse kFilled{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                           VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr VkImageSubresourceRange kColour{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .levelCount = 1, .layerCount = 1};
constexpr VkImageSubresourceLayers kLayer{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};

void recordPicture(VkCommandBuffer commands, VkImage image, const PlacedPicture& picture)
{
    const VkExtent3D extent = picture.texture->extent();
    std::vector<VkImageBlit> blits;
    for (const BlitRegion& r : blitRegions({extent.width, extent.height}, picture.firstColumn, picture.endColumn,
                                           picture.framing, picture.area)) {
        blits.push_back({.srcSubresource = kLayer,
                         .srcOffsets = {{r.from.x, r.from.y, 0}, {r.fromEnd.x, r.fromEnd.y, 1}},
                         .dstSubresource = kLayer,
                         .dstOffsets = {{r.to.x, r.to.y, 0}, {r.toEnd.x, r.toEnd.y, 1}}});
    }
    if (!blits.empty()) {
        // Magnified, single pixels stay what they are.
        const VkFilter filter = picture.framing.zoom >= 1 ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
        vkCmdBlitImage(commands, picture.texture->image(), kCopiedFrom.layout, image, kFilled.layout,
                       static_cast<uint32_t>(blits.size()), blits.data(), filter);
    }
}

} // namespace

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

void recordPictures(VkCommandBuffer commands, VkImage image, std::span<const PlacedPicture> pictures,
                    const glm::vec3& background)
{
    imageBarrier(commands, image, kAcquired, kFilled);
    const VkClearColorValue colour{{background.r, background.g, background.b, 1}};
    vkCmdClearColorImage(commands, image, kFilled.layout, &colour, 1, &kColour);
    for (const PlacedPicture& picture : pictures) {
        imageBarrier(commands, image, kFilled, kFilled); // one after the other
        recordPicture(commands, image, picture);
    }
    imageBarrier(commands, image, kFilled, kDrawnTo);
}

} // namespace nacre
