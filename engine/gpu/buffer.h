#pragma once
#include <cstdint>
#include <functional>

#include <vulkan/vulkan.h>

#include "engine/gpu/check.h"
#include "engine/gpu/context.h"

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

// A buffer that shaders read texel by texel, each of four 32-bit numbers.
class TexelBuffer {
public:
    TexelBuffer() = default;
    // Throws Error beyond the device's limits.
    TexelBuffer(const Context& context, VkFormat format, VkDeviceSize bytes, Memory memory);

    VkBufferView view() const { return view_.get(); }
    const Buffer& buffer() const { return buffer_; }
    VkDeviceSize bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_; // freed after its view
    Owned<VkBufferView, vkDestroyBufferView> view_;
};

// In the device's own memory, of what `write` leaves where it is told to.
TexelBuffer uploadTexels(const Context& context, VkFormat format, VkDeviceSize bytes,
                         const std::function<void(uint8_t*)>& write);

} // namespace nacre
