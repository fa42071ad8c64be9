#include "engine/viewer/picture_texture.h"

#include <cmath>

#include "engine/gpu/buffer.h"

namespace nacre {

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
            bytes[4 * i + c] = static_cast<uint8_t>(std::lround(255 * codes.values[3 * i + c]));
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

} // namespace nacre
