#include "engine/gpu/pass.h"

#include <array>

#include "disc_vert.h"
#include "fullscreen_vert.h"

namespace nacre {
namespace {

using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;

VkDescriptorSetLayout createSetLayout(VkDevice device, std::span<const ShaderBinding> bindings)
{
    std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
    for (const ShaderBinding& binding : bindings) {
        layoutBindings.push_back({.binding = binding.binding,
                                  .descriptorType = binding.type,
                                  .descriptorCount = 1,
                                  .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
                                  .pImmutableSamplers = nullptr});
    }
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR,
                                               .bindingCount = static_cast<uint32_t>(layoutBindings.size()),
                                               .pBindings = layoutBindings.data()};
    return created(vkCreateDescriptorSetLayout, "vkCreateDescriptorSetLayout", device, info);
}

VkPipelineLayout createLayout(VkDevice device, VkDescriptorSetLayout set, VkShaderStageFlags stages,
                              uint32_t pushConstantBytes)
{
    const VkPushConstantRange range{.stageFlags = stages, .size = pushConstantBytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set,
                                          .pushConstantRangeCount = pushConstantBytes > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    return created(vkCreatePipelineLayout, "vkCreatePipelineLayout", device, info);
}

ShaderModule makeShaderModule(VkDevice device, std::span<const uint32_t> code)
{
    const VkShaderModuleCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = code.size_bytes(), .pCode = code.data()};
    return {device, created(vkCreateShaderModule, "vkCreateShaderModule", device, info)};
}

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, const ShaderModule& module,
                                      const VkSpecializationInfo* constants = nullptr)
{
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = which,
            .module = module.get(),
            .pName = "main",
            .pSpecializationInfo = constants};
}

std::vector<VkSpecializationMapEntry> constantEntries(size_t count)
{
    std::vector<VkSpecializationMapEntry> entries(count);
    for (uint32_t i = 0; i < count; ++i) {
        entries[i] = {.constantID = i, .offset = i * uint32_t{sizeof(int32_t)}, .size = sizeof(int32_t)};
    }
    return entries;
}

std::span<const uint32_t> vertexShader(const PassDescription& pass)
{
    if (pass.vertices) {
        return pass.vertices->shader;
    }
    return pass.cover == Cover::disc ? std::span<const uint32_t>(disc_vert) : fullscreen_vert;
}

// The fixed parts that every pass has: triangles, one sample, a viewport of the target's size that is set while
// recording.
VkPipeline createPipeline(VkDevice device, VkPipelineLayout layout, const PassDescription& pass)
{
    const VertexInput noInput, &input = pass.vertices ? *pass.vertices : noInput;
    const ShaderModule vertex = makeShaderModule(device, vertexShader(pass));
    const ShaderModule fragment = makeShaderModule(device, pass.fragmentShader);
    const std::vector<VkSpecializationMapEntry> entries = constantEntries(pass.constants.size());
    const VkSpecializationInfo constants{.mapEntryCount = static_cast<uint32_t>(entries.size()),
                                         .pMapEntries = entries.data(),
                                         .dataSize = pass.constants.size_bytes(),
                                         .pData = pass.constants.data()};
    const std::array stages = {stage(VK_SHADER_STAGE_VERTEX_BIT, vertex),
                               stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment, &constants)};
    const VkVertexInputBindingDescription buffer{.binding = 0, .stride = input.stride};
    const VkPipelineVertexInputStateCreateInfo vertices{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = pass.vertices ? 1u : 0u,
        .pVertexBindingDescriptions = &buffer,
        .vertexAttributeDescriptionCount = static_cast<uint32_t>(input.attributes.size()),
        .pVertexAttributeDescriptions = input.attributes.data()};
    const VkPipelineDepthStencilStateCreateInfo nearest{.sType =
                                                            VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                                                        .depthTestEnable = VK_TRUE,
                                                        .depthWriteEnable = VK_TRUE,
                                                        .depthCompareOp = VK_COMPARE_OP_LESS};
    const VkPipelineInputAssemblyStateCreateInfo triangles{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkPipelineViewportStateCreateInfo oneViewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo filled{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo oneSample{.sType =
                                                             VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
                                                         .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineColorBlendAttachmentState blending{.blendEnable = pass.blend == Blend::add ? VK_TRUE : VK_FALSE,
                                                       .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .colorBlendOp = VK_BLEND_OP_ADD,
                                                       .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .alphaBlendOp = VK_BLEND_OP_ADD,
                                                       .colorWriteMask =
                                                           VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                           VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = 1,
                                                    .pAttachments = &blending};
    const std::array dynamicStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    const VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                   .dynamicStateCount = dynamicStates.size(),
                                                   .pDynamicStates = dynamicStates.data()};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachmentFormats = &pass.targetFormat,
                                                  .depthAttachmentFormat = input.depthFormat};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = stages.size(),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &vertices,
                                            .pInputAssemblyState = &triangles,
                                            .pViewportState = &oneViewport,
                                            .pRasterizationState = &filled,
                                            .pMultisampleState = &oneSample,
                                            .pDepthStencilState = pass.vertices ? &nearest : nullptr,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkVulkan(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "vkCreateGraphicsPipelines");
    return pipeline;
}

} // namespace

Pipeline::Pipeline(const Context& context, const PassDescription& pass)
    : setLayout_(context.device(), createSetLayout(context.device(), pass.bindings)),
      constantStages_(VK_SHADER_STAGE_FRAGMENT_BIT | (pass.vertices ? VK_SHADER_STAGE_VERTEX_BIT : 0)),
      layout_(context.device(),
              createLayout(context.device(), setLayout_.get(), constantStages_, pass.pushConstantBytes)),
      pipeline_(context.device(), createPipeline(context.device(), layout_.get(), pass)),
      vertexCount_(pass.cover == Cover::disc ? 42 : 3)
{
}

const Pipeline& Pipelines::with(std::vector<int32_t> constants)
{
    auto found = pipelines_.find(constants);
    if (found == pipelines_.end()) {
        PassDescription pass = pass_;
        pass.constants = constants;
        Pipeline pipeline(context_, pass);
        found = pipelines_.emplace(std::move(constants), std::move(pipeline)).first;
    }
    return found->second;
}

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
                                          .clearValue = {.color = {.float32 = {0, 0, 0, 0}}}};
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
