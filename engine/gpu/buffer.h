#pragma once
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"

namespace nacre {

// Memory that host and device share, mapped for its whole life and coherent: writes need no flush.
class Buffer {
public:
    Buffer() = default;
    Buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage);

    VkBuffer get() const { return buffer_.get(); }
    void* mapped() const { return mapped_; }
    VkDeviceSize bytes() const { return bytes_; }

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the buffer
    Owned<VkBuffer, vkDestroyBuffer> buffer_;
    void* mapped_ = nullptr;
    VkDeviceSize bytes_ = 0;
};

// After copies into the buffer, so that the host reads what they wrote once the commands are done.
void makeVisibleToHost(VkCommandBuffer commands, const Buffer& buffer);

} // namespace nacre
