#include "engine/gpu/pipeline.h"

#include <array>
#include <vector>

#include "disc_vert.h"
#include "engine/gpu/check.h"
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
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    checkVulkan(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    return layout;
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
    VkPipelineLayout layout = VK_NULL_HANDLE;
    checkVulkan(vkCreatePipelineLayout(device, &info, nullptr, &layout), "vkCreatePipelineLayout");
    return layout;
}

ShaderModule makeShaderModule(VkDevice device, std::span<const uint32_t> code)
{
    const VkShaderModuleCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = code.size_bytes(), .pCode = code.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    checkVulkan(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
    return {device, module};
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

} // namespace nacre
