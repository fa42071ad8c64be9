#include "engine/gpu/fours_target.h"

#include <algorithm>

#include "engine/gpu/pass.h"
#include "shared/layout.h"

namespace nacre {
namespace {

// A band that has been copied, whose texels nobody needs any more.
constexpr ImageUse kCopied{VK_IMAGE_LAYOUT_UNDEFINED, kCopiedFrom.stages, VK_ACCESS_2_NONE};

} // namespace

void FoursTarget::reset()
{
    band_ = {};
    copied_ = {};
}

// As few bands as can be, of even heights; wide enough for whole rows.
void FoursTarget::makeBand(VkExtent3D picture)
{
    const uint32_t most = std::max(1u, kBandPixels / picture.width);
    const uint32_t bands = (picture.height + most - 1) / most;
    const VkExtent3D extent{(picture.width + kPixelsPerTexel - 1) / kPixelsPerTexel,
                            (picture.height + bands - 1) / bands, 1};
    band_ = makeTarget(context_, extent, kIntegersFormat);
    copied_ = Buffer(context_, VkDeviceSize{4} * kPixelsPerTexel * extent.width * extent.height,
                     VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Memory::device);
}

// An image of four pixels a texel and one of a pixel a texel are the same bytes, but are only copied through a buffer.
// `texels` are the band's, its row 0 the picture's row `first`.
void FoursTarget::copyRows(VkCommandBuffer commands, const Texture& codes, const VkRect2D& texels, int first)
{
    const VkImageSubresourceLayers all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};
    const uint32_t left = kPixelsPerTexel * static_cast<uint32_t>(texels.offset.x);
    const uint32_t pixels = kPixelsPerTexel * texels.extent.width;
    imageBarrier(commands, band_.image(), kDrawnTo, kCopiedFrom);
    const VkBufferImageCopy out{.imageSubresource = all,
                                .imageOffset = {texels.offset.x, 0, 0},
                                .imageExtent = {texels.extent.width, texels.extent.height, 1}};
    vkCmdCopyImageToBuffer(commands, band_.image(), kCopiedFrom.layout, copied_.get(), 1, &out);
    makeVisibleToDevice(commands, copied_);
    const VkBufferImageCopy in{.bufferRowLength = pixels,
                               .imageSubresource = all,
                               .imageOffset = {static_cast<int32_t>(left), first, 0},
                               .imageExtent = {std::min(pixels, codes.extent().width - left), texels.extent.height, 1}};
    vkCmdCopyBufferToImage(commands, copied_.get(), codes.image(), kCopiedTo.layout, 1, &in);
    makeWritable(commands, copied_);
}

void FoursTarget::record(VkCommandBuffer commands, const Texture& codes, const VkRect2D& part,
                         const std::function<void(int)>& drawRows)
{
    if (part.extent.width == 0) {
        return;
    }
    if (band_.bytes() == 0) {
        makeBand(codes.extent());
    }
    const int left = part.offset.x / kPixelsPerTexel;
    const int right = (part.offset.x + static_cast<int>(part.extent.width) + kPixelsPerTexel - 1) / kPixelsPerTexel;
    const int end = part.offset.y + static_cast<int>(part.extent.height);
    const int rows = static_cast<int>(band_.extent().height);
    imageBarrier(commands, codes.image(), kDrawnTo, kCopiedTo);
    for (int first = part.offset.y; first < end; first += rows) {
        const VkRect2D texels{
            .offset = {left, 0},
            .extent = {static_cast<uint32_t>(right - left), static_cast<uint32_t>(std::min(rows, end - first))}};
        imageBarrier(commands, band_.image(), kCopied, kDrawnTo);
        beginRendering(commands, band_, Load::clear, texels);
        drawRows(first);
        vkCmdEndRendering(commands);
        copyRows(commands, codes, texels, first);
    }
    imageBarrier(commands, codes.image(), kCopiedTo, kDrawnTo);
}

} // namespace nacre
