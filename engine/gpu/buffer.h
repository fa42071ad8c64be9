#pragma once
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"

namespace nacre {

// shared by host and device: mapped for its whole life and coherent, so that writes need no flush. device: its own.
enum class Memory { shared, device };

class Buffer {
public:
    Buffer() = default;
    Buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage, Memory memory = Memory::shared);

    VkBuffer get() const { return buffer_.get(); }
    void* mapped() const { return mapped_; } // null where the memory is the device's own
    VkDeviceSize bytes() const { return bytes_; }

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the buffer
    Owned<VkBuffer, vkDestroyBuffer> buffer_;
    void* mapped_ = nullptr;
    VkDeviceSize bytes_ = 0;
};

// After copies into the buffer, so that the host reads what they wrote once the commands are done.
void makeVisibleToHost(VkCommandBuffer commands, const Buffer& buffer);
// After copies into it, so that copies from it and shaders read what they wrote.
void makeVisibleToDevice(VkCommandBuffer commands, const Buffer& buffer);
// After copies from it, so that copies into it do not overtake them.
void makeWritable(VkCommandBuffer commands, const Buffer& buffer);

} // namespace nacre
