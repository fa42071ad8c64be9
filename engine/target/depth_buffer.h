#pragma once
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"

namespace nacre {

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

// Depth in 32-bit floats, for one target.
class DepthBuffer {
public:
    DepthBuffer(const Context& context, VkExtent3D extent);
    VkImage image() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the image and its view
    Owned<VkImage, vkDestroyImage> image_;
    Owned<VkImageView, vkDestroyImageView> view_;
};

} // namespace nacre
