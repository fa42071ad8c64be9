#include "engine/target/depth_buffer.h"
#include "engine/gpu/check.h"

namespace nacre {
namespace {

VkImage createImage(VkDevice device, VkExtent3D extent)
{
    const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                 .imageType = VK_IMAGE_TYPE_2D,
                                 .format = kDepthFormat,
                                 .extent = extent,
                                 .mipLevels = 1,
                                 .arrayLayers = 1,
                                 .samples = VK_SAMPLE_COUNT_1_BIT,
                                 .tiling = VK_IMAGE_TILING_OPTIMAL,
                                 .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 .initialLayout = VK_IMAGE_LAYOUT_UNDEFINED};
    VkImage image = VK_NULL_HANDLE;
    checkVulkan(vkCreateImage(device, &info, nullptr, &image), "vkCreateImage");
    return image;
}

VkDeviceMemory allocateOnDevice(const Context& context, VkImage image)
{
    VkMemoryRequirements requirements;
    vkGetImageMemoryRequirements(context.device(), image, &requirements);
    const VkMemoryAllocateInfo info{
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = requirements.size,
        .memoryTypeIndex = context.memoryType(requirements.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT)};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    checkVulkan(vkAllocateMemory(context.device(), &info, nullptr, &memory), "vkAllocateMemory");
    return memory;
}

VkImageView createView(VkDevice device, VkImage image)
{
    const VkImageViewCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = kDepthFormat,
        .subresourceRange = {.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT, .levelCount = 1, .layerCount = 1}};
    VkImageView view = VK_NULL_HANDLE;
    checkVulkan(vkCreateImageView(device, &info, nullptr, &view), "vkCreateImageView");
    return view;
}

} // namespace

DepthBuffer::DepthBuffer(const Context& context, VkExtent3D extent)
    : image_(context.device(), createImage(context.device(), extent))
{
    memory_ = {context.device(), allocateOnDevice(context, image_.get())};
    checkVulkan(vkBindImageMemory(context.device(), image_.get(), memory_.get(), 0), "vkBindImageMemory");
    view_ = {context.device(), createView(context.device(), image_.get())};
}

} // namespace nacre
