#pragma once
#include <span>

#include <glm/vec4.hpp>
#include <vulkan/vulkan.h>

#include "engine/gpu/check.h"
#include "engine/gpu/context.h"

namespace nacre {

// Four channels a texel:
inline constexpr VkFormat kFloatFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat kHalfFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat kCodeFormat = VK_FORMAT_B8G8R8A8_UNORM; // codes of the display, as windows want them
// Two channels in [-1, 1].
inline constexpr VkFormat kPackedNormalFormat = VK_FORMAT_R16G16_SNORM;

// Four channels of 32-bit integers.
inline constexpr VkFormat kIntegersFormat = VK_FORMAT_R32G32B32A32_UINT;

// One channel in [0, 1].
inline constexpr VkFormat kByteFormat = VK_FORMAT_R8_UNORM;
inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

// An image in device memory, without mip levels.
class Texture {
public:
    struct Description {
        VkImageType type = VK_IMAGE_TYPE_2D;
        VkExtent3D extent{}; // depth is 1 unless 3D
        VkFormat format = kFloatFormat;
        VkImageUsageFlags usage = 0;
        uint32_t layers = 0; // of a 2D array; 0: it is none
    };

    Texture() = default;
    // Throws Error beyond the device's limits.
    Texture(const Context& context, const Description& description);

    VkImage image() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }
    VkExtent3D extent() const { return description_.extent; }
    VkFormat format() const { return description_.format; }
    uint32_t layers() const { return description_.layers; }
    VkDeviceSize bytes() const { return bytes_; } // of device memory

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the image and its view
    Owned<VkImage, vkDestroyImage> image_;
    Owned<VkImageView, vkDestroyImageView> view_;
    Description description_;
    VkDeviceSize bytes_ = 0;
};

// A texture for shaders to read; its texels x fastest, then y, then z. Formats other than kFloatFormat are packed here.
Texture uploadTexture(const Context& context, VkImageType type, VkExtent3D extent, VkFormat format,
                      std::span<const glm::vec4> texels);

// A 2D array of kByteFormat for shaders to read, layer by layer. Throws Error beyond the device's limits.
Texture uploadLayers(const Context& context, VkExtent3D extent, uint32_t layers, std::span<const uint8_t> texels);

// A 2D texture to draw or copy to, and to read or copy from.
Texture makeTarget(const Context& context, VkExtent3D extent, VkFormat format);

// Throws Error where a picture of this size is beyond the device's limits (or empty).
void requirePictureSize(const Context& context, int width, int height);

using Sampler = Owned<VkSampler, vkDestroySampler>;
// Clamps to the border's texels.
Sampler makeSampler(const Context& context, VkFilter filter);

// One side of a barrier: what has, or will have, touched the image, and the layout it is in for that.
struct ImageUse {
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
};
inline constexpr ImageUse kUnused{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};
// What shaders have read before and nobody needs any more.
inline constexpr ImageUse kDiscarded{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                     VK_ACCESS_2_NONE};
inline constexpr ImageUse kCopiedTo{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                    VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr ImageUse kCopiedFrom{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                      VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT,
                                      VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr ImageUse kSampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                   VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr ImageUse kDrawnTo{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                   VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                   VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

void imageBarrier(VkCommandBuffer commands, VkImage image, const ImageUse& before, const ImageUse& after,
                  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT);

// Of all texels, between 2D textures of one size and format: `from` is in kCopiedFrom, `to` in kCopiedTo.
void recordWholeCopy(VkCommandBuffer commands, const Texture& from, const Texture& to);

} // namespace nacre
