#include "engine/gpu/pass.h"

#include <vector>

namespace nacre {

ShaderInput textureInput(int binding, const Sampler& sampler, const Texture& texture)
{
    return {.binding = static_cast<uint32_t>(binding),
            .image = {.sampler = sampler.get(), .imageView = texture.view(), .imageLayout = kSampled.layout}};
}

ShaderInput uniformInput(int binding, const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes)
{
    return {.binding = static_cast<uint32_t>(binding), .buffer = {buffer.get(), offset, bytes}};
}

ShaderInput texelInput(int binding, const TexelBuffer& texels)
{
    return {.binding = static_cast<uint32_t>(binding), .texels = texels.view()};
}

void beginRendering(VkCommandBuffer commands, const Texture& target, Load load, VkRect2D area)
{
    if (area.extent.width == 0) {
        area.extent = {target.extent().width, target.extent().height};
    }
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = target.view(),
                                          .imageLayout = kDrawnTo.layout,
                                          .loadOp = load == Load::clear ? VK_ATTACHMENT_LOAD_OP_CLEAR
                                                                        : VK_ATTACHMENT_LOAD_OP_LOAD,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                          .clearValue = {.color = {.float32 = {0, 0, 0, 1}}}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = area,
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{.x = static_cast<float>(area.offset.x),
                              .y = static_cast<float>(area.offset.y),
                              .width = static_cast<float>(area.extent.width),
                              .height = static_cast<float>(area.extent.height),
                              .maxDepth = 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
}

void draw(const Context& context, VkCommandBuffer commands, const Pipeline& pipeline,
          std::span<const ShaderInput> inputs, std::span<const std::byte> constants)
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    std::vector<VkWriteDescriptorSet> writes;
    for (const ShaderInput& input : inputs) {
        const bool isBuffer = input.buffer.buffer != VK_NULL_HANDLE, isTexels = input.texels != VK_NULL_HANDLE;
        writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                          .dstBinding = input.binding,
                          .descriptorCount = 1,
                          .descriptorType = isTexels   ? kTexelInput
                                            : isBuffer ? kUniformInput
                                                       : kTextureInput,
                          .pImageInfo = &input.image,
                          .pBufferInfo = &input.buffer,
                          .pTexelBufferView = &input.texels});
    }
    context.pushDescriptorSet(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout(), 0,
                              static_cast<uint32_t>(writes.size()), writes.data());
    if (!constants.empty()) {
        vkCmdPushConstants(commands, pipeline.layout(), pipeline.constantStages(), 0,
                           static_cast<uint32_t>(constants.size()), constants.data());
    }
    vkCmdDraw(commands, pipeline.vertexCount(), 1, 0, 0);
}

} // namespace nacre
