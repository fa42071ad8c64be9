#include "engine/gpu/canvas.h"

#include <cstring>
#include <utility>

namespace nacre {

void Canvas::dropPixels()
{
    pixels_.reset();
    ballFrame.dropPixels();
    directFrame.reset();
    isStale = true;
}

void Canvas::dropPicture()
{
    ballFrame.reset();
    codes_.reset();
    isStale = true;
}

const PixelTextures& Canvas::pixels(const Surface& surface, bool plain)
{
    if (!pixels_) {
        pixels_ = std::make_shared<PixelTextures>(uploadPixels(context_, surface, plain, Precision::compact));
    }
    return *pixels_;
}

void Canvas::usePixels(std::shared_ptr<const PixelTextures> pixels)
{
    const VkExtent3D extent = pixels->normals.extent();
    if (codes_ && (codes_->extent().width != extent.width || codes_->extent().height != extent.height)) {
        dropPicture();
    }
    dropPixels();
    pixels_ = std::move(pixels);
}

void Canvas::draw(Draws draws, const std::function<void(VkCommandBuffer, const Texture&)>& record)
{
    const VkExtent3D extent = pixels_->normals.extent();
    const bool isNew = !codes_;
    if (isNew) {
        codes_ = makeTarget(context_, extent, kCodeFormat);
    }
    const VkRect2D part =
        draws == Draws::whatIsShown ? pixels_->shown : VkRect2D{.offset = {}, .extent = {extent.width, extent.height}};
    const bool isBlackBeside = !isNew && std::memcmp(&part, &drawn_, sizeof part) == 0;
    drawn_ = part;
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, codes_->image(), isBlackBeside ? kCopiedFrom : kDiscarded, kDrawnTo);
        if (!isBlackBeside) {
            beginRendering(commands, *codes_, Load::clear);
            vkCmdEndRendering(commands);
        }
        record(commands, *codes_);
        imageBarrier(commands, codes_->image(), kDrawnTo, kCopiedFrom);
    });
    isStale = false;
}

VkDeviceSize Canvas::bytes() const
{
    return ballFrame.bytes() + directFrame.bytes() + (pixels_ ? pixels_->bytes() : 0) + (codes_ ? codes_->bytes() : 0);
}

Image readCodes(const Context& context, const Texture& codes)
{
    const VkExtent3D extent = codes.extent();
    const Buffer readback(context, VkDeviceSize{4} * extent.width * extent.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    context.run([&](VkCommandBuffer commands) {
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = extent};
        vkCmdCopyImageToBuffer(commands, codes.image(), kCopiedFrom.layout, readback.get(), 1, &copy);
        makeVisibleToHost(commands, readback);
    });
    Image picture(static_cast<int>(extent.width), static_cast<int>(extent.height), 3);
    const auto* bytes = static_cast<const uint8_t*>(readback.mapped());
    for (size_t i = 0; i < picture.pixelCount(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            picture.values[3 * i + c] = static_cast<float>(bytes[4 * i + 2 - c]) / 255.0f;
        }
    }
    return picture;
}

} // namespace nacre
