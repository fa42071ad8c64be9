#include "engine/gpu/buffer.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {
namespace {

VkBuffer createBuffer(VkDevice device, VkDeviceSize bytes, VkBufferUsageFlags usage)
{
    const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
    return created(vkCreateBuffer, "vkCreateBuffer", device, info);
}

Owned<VkDeviceMemory, vkFreeMemory> allocate(const Context& context, VkBuffer buffer, Memory memory)
{
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(context.device(), buffer, &requirements);
    if (memory == Memory::device) {
        return context.allocate(requirements, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    }
    // Cached memory reads frames back at the speed of memory instead of the bus's.
    return context.allocate(requirements, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                            VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
}

void barrierAfterCopy(VkCommandBuffer commands, const Buffer& buffer, VkPipelineStageFlags2 stages,
                      VkAccessFlags2 access)
{
    const VkBufferMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_BUFFER_MEMORY_BARRIER_2,
                                         .srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT,
                                         .srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                         .dstStageMask = stages,
                                         .dstAccessMask = access,
                                         .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                         .buffer = buffer.get(),
                                         .size = VK_WHOLE_SIZE};
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .bufferMemoryBarrierCount = 1, .pBufferMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &dependency);
}

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

VkBufferView createTexelView(VkDevice device, const Buffer& buffer, VkFormat format)
{
    const VkBufferViewCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
                                      .buffer = buffer.get(),
                                      .format = format,
                                      .range = VK_WHOLE_SIZE};
    return created(vkCreateBufferView, "vkCreateBufferView", device, info);
}

} // namespace

Buffer::Buffer(const Context& context, VkDeviceSize bytes, VkBufferUsageFlags usage, Memory memory)
    : buffer_(context.device(), createBuffer(context.device(), bytes, usage)), bytes_(bytes)
{
    memory_ = allocate(context, buffer_.get(), memory);
    checkVulkan(vkBindBufferMemory(context.device(), buffer_.get(), memory_.get(), 0), "vkBindBufferMemory");
    if (memory == Memory::shared) {
        checkVulkan(vkMapMemory(context.device(), memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
    }
}

void makeVisibleToHost(VkCommandBuffer commands, const Buffer& buffer)
{
    barrierAfterCopy(commands, buffer, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

void makeVisibleToDevice(VkCommandBuffer commands, const Buffer& buffer)
{
    barrierAfterCopy(commands, buffer, VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                     VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT);
}

void makeWritable(VkCommandBuffer commands, const Buffer& buffer)
{
    barrierAfterCopy(commands, buffer, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
}

TexelBuffer::TexelBuffer(const Context& context, VkFormat format, VkDeviceSize bytes, Memory memory)
{
    requireTexels(context, bytes);
    buffer_ =
        Buffer(context, bytes, VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT, memory);
    view_ = {context.device(), createTexelView(context.device(), buffer_, format)};
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
