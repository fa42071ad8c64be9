#include "engine/gpu/texture.h"

#include <algorithm>
#include <cassert>
#include <cstring>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>
#include <glm/packing.hpp>

#include "engine/files/error.h"
#include "engine/gpu/buffer.h"

namespace nacre {
namespace {

VkImageSubresourceRange wholeImage(VkImageAspectFlags aspect)
{
    return {.aspectMask = aspect, .levelCount = 1, .layerCount = VK_REMAINING_ARRAY_LAYERS};
}

void requireTableSize(const Context& context, VkExtent3D extent)
{
    const uint32_t limit = context.limits().maxImageDimension3D;
    const VkDeviceSize texelLimit = context.largestAllocation() / sizeof(glm::vec4);
    if (std::max({extent.width, extent.height, extent.depth}) > limit ||
        VkDeviceSize{extent.width} * extent.height * extent.depth > texelLimit) {
        throw Error({},
                    fmt::format("a table of {} x {} x {} texels is too large for the Vulkan device {}", extent.width,
                                extent.height, extent.depth, context.info().name),
                    fmt::format("at most {} each way, {} million in all", limit, texelLimit / 1000000));
    }
}

VkImage createImage(VkDevice device, const Texture::Description& description)
{
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = description.type,
                                 .format = description.format,
                                 .extent = description.extent,
                                 .mipLevels = 1,
                                 .arrayLayers = std::max(1u, description.layers),
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = description.usage,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    return created(vkCreateImage, "vkCreateImage", device, info);
}

VkImageView createView(VkDevice device, VkImage image, const Texture::Description& description)
{
    const bool solid = description.type == VK_IMAGE_TYPE_3D, isArray = description.layers > 0;
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = solid     ? VK_IMAGE_VIEW_TYPE_3D
                    : isArray ? VK_IMAGE_VIEW_TYPE_2D_ARRAY
                              : VK_IMAGE_VIEW_TYPE_2D,
        .format = description.format,
        .subresourceRange =
            wholeImage(description.format == kDepthFormat ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT)};
    return created(vkCreateImageView, "vkCreateImageView", device, info);
}

template <class Pack> auto packed(std::span<const glm::vec4> texels, Pack&& pack)
{
    std::vector<decltype(pack(texels[0]))> words(texels.size());
    std::transform(texels.begin(), texels.end(), words.begin(), pack);
    return words;
}

template <class Texel> void copyToTexture(const Context& context, const Texture& texture, std::span<const Texel> texels)
{
    const Buffer staging(context, texels.size_bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.mapped(), texels.data(), texels.size_bytes());
    context.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, texture.image(), kUnused, kCopiedTo);
        const VkBufferImageCopy copy{
            .imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = std::max(1u, texture.layers())},
            .imageExtent = texture.extent()};
        vkCmdCopyBufferToImage(commands, staging.get(), texture.image(), kCopiedTo.layout, 1, &copy);
        imageBarrier(commands, texture.image(), kCopiedTo, kSampled);
    });
}

} // namespace

Texture::Texture(const Context& context, const Description& description) : description_(description)
{
    const VkExtent3D& extent = description.extent;
    if (description.type == VK_IMAGE_TYPE_3D) {
        requireTableSize(context, extent);
    } else {
        requirePictureSize(context, static_cast<int>(extent.width), static_cast<int>(extent.height));
    }
    image_ = {context.device(), createImage(context.device(), description)};
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(context.device(), image_.get(), &requirements);
    bytes_ = requirements.size;
    memory_ = context.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    checkVulkan(vkBindImageMemory(context.device(), image_.get(), memory_.get(), 0), "vkBindImageMemory");
    view_ = {context.device(), createView(context.device(), image_.get(), description)};
}

Texture uploadTexture(const Context& context, VkImageType type, VkExtent3D extent, VkFormat format,
                      std::span<const glm::vec4> texels)
{
    assert(texels.size() == size_t{extent.width} * extent.height * extent.depth);
    Texture texture(context, {.type = type,
                              .extent = extent,
                              .format = format,
                              .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT});
    if (format == kFloatFormat) {
        copyToTexture(context, texture, texels);
    } else if (format == kHalfFormat) {
        copyToTexture<uint64_t>(context, texture,
                                packed(texels, [](const glm::vec4& t) { return glm::packHalf4x16(t); }));
    } else {
        assert(format == kPackedNormalFormat);
        copyToTexture<uint32_t>(context, texture,
                                packed(texels, [](const glm::vec4& t) { return glm::packSnorm2x16(glm::vec2(t)); }));
    }
    return texture;
}

Texture uploadLayers(const Context& context, VkExtent3D extent, uint32_t layers, std::span<const uint8_t> texels)
{
    assert(texels.size() == size_t{extent.width} * extent.height * layers);
    Texture texture(context, {.extent = extent,
                              .format = kByteFormat,
                              .usage = VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                              .layers = layers});
    copyToTexture(context, texture, texels);
    return texture;
}

Texture makeTarget(const Context& context, VkExtent3D extent, VkFormat format)
{
    return Texture(context, {.extent = extent,
                             .format = format,
                             .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                      VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT});
}

void requirePictureSize(const Context& context, int width, int height)
{
    const auto limit = static_cast<int>(context.limits().maxImageDimension2D);
    const VkDeviceSize pixelLimit = context.largestAllocation() / sizeof(glm::vec4);
    const bool fits = width >= 1 && height >= 1 && std::max(width, height) <= limit &&
                      static_cast<VkDeviceSize>(width) * static_cast<VkDeviceSize>(height) <= pixelLimit;
    if (!fits) {
        throw Error({},
                    fmt::format("the Vulkan device {} cannot draw {} x {} pixels", context.info().name, width, height),
                    fmt::format("1 to {} each way, {} million in all", limit, pixelLimit / 1000000));
    }
}

Sampler makeSampler(const Context& context, VkFilter filter)
{
    const VkSamplerCreateInfo info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = filter,
                                   .minFilter = filter,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST,
                                   .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                   .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    return {context.device(), created(vkCreateSampler, "vkCreateSampler", context.device(), info)};
}

void imageBarrier(VkCommandBuffer commands, VkImage image, const ImageUse& before, const ImageUse& after,
                  VkImageAspectFlags aspect)
{
    const VkImageMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                        .srcStageMask = before.stages,
                                        .srcAccessMask = before.access,
                                        .dstStageMask = after.stages,
                                        .dstAccessMask = after.access,
                                        .oldLayout = before.layout,
                                        .newLayout = after.layout,
                                        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                        .image = image,
                                        .subresourceRange = wholeImage(aspect)};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

void recordWholeCopy(VkCommandBuffer commands, const Texture& from, const Texture& to)
{
    constexpr VkImageSubresourceLayers kAll{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};
    const VkImageCopy copy{.srcSubresource = kAll, .dstSubresource = kAll, .extent = from.extent()};
    vkCmdCopyImage(commands, from.image(), kCopiedFrom.layout, to.image(), kCopiedTo.layout, 1, &copy);
}

} // namespace nacre
