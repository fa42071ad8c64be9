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
void FoursTarget::copyRows(VkCommandBuffer commands, const Texture& codes, int first, uint32_t count)
{
    const VkImageSubresourceLayers all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};
    const uint32_t texels = band_.extent().width;
    imageBarrier(commands, band_.image(), kDrawnTo, kCopiedFrom);
    const VkBufferImageCopy out{.imageSubresource = all, .imageExtent = {texels, count, 1}};
    vkCmdCopyImageToBuffer(commands, band_.image(), kCopiedFrom.layout, copied_.get(), 1, &out);
    makeVisibleToDevice(commands, copied_);
    const VkBufferImageCopy in{.bufferRowLength = kPixelsPerTexel * texels,
                               .imageSubresource = all,
                               .imageOffset = {0, first, 0},
                               .imageExtent = {codes.extent().width, count, 1}};
    vkCmdCopyBufferToImage(commands, copied_.get(), codes.image(), kCopiedTo.layout, 1, &in);
    makeWritable(commands, copied_);
}

void FoursTarget::record(VkCommandBuffer commands, const Texture& codes, const std::function<void(int)>& drawRows)
{
    if (band_.bytes() == 0) {
        makeBand(codes.extent());
    }
    const VkExtent3D band = band_.extent();
    imageBarrier(commands, codes.image(), kDrawnTo, kCopiedTo);
    for (uint32_t first = 0; first < codes.extent().height; first += band.height) {
        const uint32_t count = std::min(band.height, codes.extent().height - first);
        imageBarrier(commands, band_.image(), kCopied, kDrawnTo);
        beginRendering(commands, band_, Load::clear, {.offset = {}, .extent = {band.width, count}});
        drawRows(static_cast<int>(first));
        vkCmdEndRendering(commands);
        copyRows(commands, codes, static_cast<int>(first), count);
    }
    imageBarrier(commands, codes.image(), kCopiedTo, kDrawnTo);
}

} // namespace nacre
