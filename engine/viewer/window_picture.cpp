#include "engine/viewer/window_picture.h"

#include <bit>

#include <glm/common.hpp>

#include "engine/files/hash_random.h"
#include "engine/gpu/pass.h"

namespace nacre {
namespace {

constexpr ImageUse kAcquired{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};
constexpr ImageUse kPresented{VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};
constexpr VkImageSubresourceLayers kLayer{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};

void recordClear(VkCommandBuffer commands, const Texture& target, std::span<const PixelBox> boxes,
                 const glm::vec3& colour)
{
    const VkClearAttachment clear{
        .aspectMask = VK_IMAGE_ASPECT_COLOR_BIT,
        .colorAttachment = 0,
        .clearValue = {.color = {.float32 = {colour.r, colour.g, colour.b, 1}}},
    };
    std::vector<VkClearRect> rectangles;
    for (const PixelBox& box : boxes) {
        const glm::uvec2 size(box.high - box.low);
        rectangles.push_back(
            {.rect = {{box.low.x, box.low.y}, {size.x, size.y}}, .baseArrayLayer = 0, .layerCount = 1});
    }
    beginRendering(commands, target, Load::keep);
    if (!rectangles.empty()) {
        vkCmdClearAttachments(commands, 1, &clear, static_cast<uint32_t>(rectangles.size()), rectangles.data());
    }
    vkCmdEndRendering(commands);
}

// The same texture in the same place.
uint64_t lookOf(const PlacedPicture& picture)
{
    const glm::vec2 corner = screenFromPicture({0, 0}, picture.framing, picture.area);
    return hashOf(reinterpret_cast<uint64_t>(picture.texture->image()) ^ hashOf(std::bit_cast<uint64_t>(corner)));
}

PlacedPicture cutTo(const PixelBox& box, PlacedPicture picture)
{
    const Area before = picture.area;
    picture.area.origin = glm::max(before.origin, glm::vec2(box.low));
    picture.area.size =
        glm::max(glm::min(before.origin + before.size, glm::vec2(box.high)) - picture.area.origin, 0.0f);
    picture.framing.centre += (picture.area.middle() - before.middle()) / picture.framing.zoom;
    return picture;
}

// Still ones as far as the boxes reach: elsewhere ImGui may have drawn over them.
std::vector<PlacedPicture> picturesIn(std::span<const PixelBox> boxes, std::span<const PlacedPicture> pictures)
{
    std::vector<PlacedPicture> drawn;
    for (const PlacedPicture& picture : pictures) {
        if (!picture.isStill) {
            drawn.push_back(picture);
            continue;
        }
        for (const PixelBox& box : boxes) {
            if (!overlap(box, boxOf(picture)).isEmpty()) {
                drawn.push_back(cutTo(box, picture));
            }
        }
    }
    return drawn;
}

} // namespace

ImageUse WindowPicture::follow(const Swapchain& swapchain)
{
    const VkExtent3D extent{swapchain.extent().width, swapchain.extent().height, 1};
    if (!picture_ || picture_->extent().width != extent.width || picture_->extent().height != extent.height) {
        picture_ = makeTarget(context_, extent, swapchain.format());
        tiles_.forget();
        return kUnused;
    }
    return kCopiedFrom;
}

void WindowPicture::record(VkCommandBuffer commands, const Swapchain& swapchain, size_t image,
                           std::span<const PlacedPicture> pictures, const glm::vec3& background, UiPass& ui)
{
    const ImageUse before = follow(swapchain);
    ++frames_;
    tiles_.begin(glm::ivec2(swapchain.extent().width, swapchain.extent().height));
    for (const PlacedPicture& picture : pictures) {
        tiles_.add(boxOf(picture), picture.isStill ? lookOf(picture) : frames_);
    }
    ui.addLooks(tiles_);
    const std::vector<PixelBox> changed = tiles_.changed();

    imageBarrier(commands, picture_->image(), before, kDrawnTo);
    recordClear(commands, *picture_, changed, background);
    recordPictures(commands, *picture_, picturesIn(changed, pictures));
    ui.record(commands, *picture_, changed);
    imageBarrier(commands, picture_->image(), kDrawnTo, kCopiedFrom);

    imageBarrier(commands, swapchain.image(image), kAcquired, kCopiedTo);
    const VkImageCopy all{.srcSubresource = kLayer, .dstSubresource = kLayer, .extent = picture_->extent()};
    vkCmdCopyImage(commands, picture_->image(), kCopiedFrom.layout, swapchain.image(image), kCopiedTo.layout, 1, &all);
    imageBarrier(commands, swapchain.image(image), kCopiedTo, kPresented);
}

} // namespace nacre
