#pragma once
#include <functional>

#include "engine/gpu/buffer.h"

namespace nacre {

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
