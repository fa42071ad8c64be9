#pragma once
#include <span>

#include <glm/vec4.hpp>
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"

namespace nacre {

// A 2D or 3D image of four floats a texel in device memory, without mip levels.
class Texture {
public:
    static constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;

    Texture() = default;
    // 3D where type says so; extent.depth is 1 otherwise. Throws Error beyond the device's limits.
    Texture(const Context& context, VkImageType type, VkExtent3D extent, VkImageUsageFlags usage);

    VkImage image() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }
    VkExtent3D extent() const { return extent_; }

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the image and its view
    Owned<VkImage, vkDestroyImage> image_;
    Owned<VkImageView, vkDestroyImageView> view_;
    VkExtent3D extent_{};
};

// A texture for shaders to read, x fastest, then y, then z.
Texture uploadTexture(const Context& context, VkImageType type, VkExtent3D extent, std::span<const glm::vec4> texels);

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
inline constexpr ImageUse kCopiedTo{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                    VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr ImageUse kCopiedFrom{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                      VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr ImageUse kSampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                   VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr ImageUse kDrawnTo{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                   VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                   VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

void imageBarrier(VkCommandBuffer commands, VkImage image, const ImageUse& before, const ImageUse& after);

} // namespace nacre
