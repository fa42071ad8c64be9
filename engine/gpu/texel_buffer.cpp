#include "engine/gpu/texel_buffer.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/gpu/check.h"

namespace nacre {
namespace {

constexpr VkDeviceSize kBytesPerTexel = 16;

void requireTexels(const Context& context, VkDeviceSize bytes)
{
    const VkDeviceSize most =
        std::min(context.limits().maxTexelBufferElements * kBytesPerTexel, context.largestAllocation());
    if (bytes > most) {
        throw Error(
            {},
            fmt::format("a buffer of {} MiB is too large for the Vulkan device {}", bytes >> 20, context.info().name),
            fmt::format("at most {} MiB", most >> 20));
    }
}

VkBufferView createView(VkDevice device, const Buffer& buffer, VkFormat format)
{
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = buffer.get(),
                                      .format = format,
                                      .range = VK_WHOLE_SIZE};
    VkBufferView view = VK_NULL_HANDLE;
    checkVulkan(vkCreateBufferView(device, &info, nullptr, &view), "vkCreateBufferView");
    return view;
}

} // namespace

TexelBuffer::TexelBuffer(const Context& context, VkFormat format, VkDeviceSize bytes, Memory memory)
{
    requireTexels(context, bytes);
    buffer_ =
        Buffer(context, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, memory);
    view_ = {context.device(), createView(context.device(), buffer_, format)};
}

TexelBuffer uploadTexels(const Context& context, VkFormat format, VkDeviceSize bytes,
                         const std::function<void(uint8_t*)>& write)
{
    TexelBuffer texels(context, format, bytes, Memory::device);
    const Buffer staging(context, bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    write(static_cast<uint8_t*>(staging.mapped()));
    context.run([&](VkCommandBuffer commands) {
        const VkBufferCopy all{.size = bytes};
        vkCmdCopyBuffer(commands, staging.get(), texels.buffer().get(), 1, &all);
        makeVisibleToDevice(commands, texels.buffer());
    });
    return texels;
}

} // namespace nacre
