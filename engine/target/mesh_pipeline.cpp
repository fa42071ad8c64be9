#include "engine/target/mesh_pipeline.h"

#include <array>
#include <span>

#include "engine/gpu/check.h"
#include "mesh_view_frag.h"
#include "mesh_view_vert.h"
#include "shared/mesh_layout.h"

namespace nacre {
namespace {

using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;

VkDescriptorSetLayout createSetLayout(VkDevice device)
{
    const VkDescriptorSetLayoutBinding map{.binding = kBindingMeshNormalMap,
                                           .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                           .descriptorCount = 1,
                                           .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};
    const VkDescriptorSetLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                               .flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR,
                                               .bindingCount = 1,
                                               .pBindings = &map};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    checkVulkan(vkCreateDescriptorSetLayout(device, &info, nullptr, &layout), "vkCreateDescriptorSetLayout");
    return layout;
}

VkPipelineLayout createLayout(VkDevice device, VkDescriptorSetLayout set)
{
    const VkPushConstantRange range{.stageFlags = kMeshStages, .size = sizeof(MeshConstants)};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = 1,
                                          .pSetLayouts = &set,
                                          .pushConstantRangeCount = 1,
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

constexpr VkVertexInputBindingDescription kVertex{.binding = 0, .stride = sizeof(MeshVertex)};

VkVertexInputAttributeDescription attribute(int location, VkFormat format, size_t offset)
{
    return {.location = static_cast<uint32_t>(location), .format = format, .offset = static_cast<uint32_t>(offset)};
}

// The parts that never change: triangles of both sides, one sample, the nearest is kept.
constexpr VkPipelineInputAssemblyStateCreateInfo kTriangles{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
    .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
constexpr VkPipelineViewportStateCreateInfo kOneViewport{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
constexpr VkPipelineRasterizationStateCreateInfo kFilled{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .cullMode = VK_CULL_MODE_NONE, .lineWidth = 1};
constexpr VkPipelineMultisampleStateCreateInfo kOneSample{
    .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO, .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
constexpr VkPipelineDepthStencilStateCreateInfo kNearest{.sType =
                                                             VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                                                         .depthTestEnable = VK_TRUE,
                                                         .depthWriteEnable = VK_TRUE,
                                                         .depthCompareOp = VK_COMPARE_OP_LESS};
constexpr VkPipelineColorBlendAttachmentState kReplacing{.colorWriteMask =
                                                             VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                                             VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT};
constexpr std::array kDynamicStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};

VkPipeline createPipeline(VkDevice device, VkPipelineLayout layout, bool mapped)
{
    const ShaderModule vertex = makeShaderModule(device, mesh_view_vert);
    const ShaderModule fragment = makeShaderModule(device, mesh_view_frag);
    const VkBool32 isMapped = mapped ? VK_TRUE : VK_FALSE;
    const VkSpecializationMapEntry entry{.constantID = kConstantMeshMapped, .size = sizeof(isMapped)};
    const VkSpecializationInfo constants{
        .mapEntryCount = 1, .pMapEntries = &entry, .dataSize = sizeof(isMapped), .pData = &isMapped};
    const std::array stages = {
        VkPipelineShaderStageCreateInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                        .stage = VK_SHADER_STAGE_VERTEX_BIT,
                                        .module = vertex.get(),
                                        .pName = "main"},
        VkPipelineShaderStageCreateInfo{.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                                        .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
                                        .module = fragment.get(),
                                        .pName = "main",
                                        .pSpecializationInfo = &constants}};
    const std::array attributes = {
        attribute(kMeshPoint, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, point)),
        attribute(kMeshNormal, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, normal)),
        attribute(kMeshTangent, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(MeshVertex, tangent)),
        attribute(kMeshUv, VK_FORMAT_R32G32_SFLOAT, offsetof(MeshVertex, uv))};
    const VkPipelineVertexInputStateCreateInfo vertices{.sType =
                                                            VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
                                                        .vertexBindingDescriptionCount = 1,
                                                        .pVertexBindingDescriptions = &kVertex,
                                                        .vertexAttributeDescriptionCount = attributes.size(),
                                                        .pVertexAttributeDescriptions = attributes.data()};
    const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                    .attachmentCount = 1,
                                                    .pAttachments = &kReplacing};
    const VkPipelineDynamicStateCreateInfo dynamic{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                   .dynamicStateCount = kDynamicStates.size(),
                                                   .pDynamicStates = kDynamicStates.data()};
    const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                  .colorAttachmentCount = 1,
                                                  .pColorAttachmentFormats = &kFloatFormat,
                                                  .depthAttachmentFormat = kDepthFormat};
    const VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                            .pNext = &rendering,
                                            .stageCount = stages.size(),
                                            .pStages = stages.data(),
                                            .pVertexInputState = &vertices,
                                            .pInputAssemblyState = &kTriangles,
                                            .pViewportState = &kOneViewport,
                                            .pRasterizationState = &kFilled,
                                            .pMultisampleState = &kOneSample,
                                            .pDepthStencilState = &kNearest,
                                            .pColorBlendState = &blend,
                                            .pDynamicState = &dynamic,
                                            .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    checkVulkan(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
                "vkCreateGraphicsPipelines");
    return pipeline;
}

} // namespace

MeshPipeline::MeshPipeline(const Context& context, bool mapped)
    : setLayout_(context.device(), createSetLayout(context.device())),
      layout_(context.device(), createLayout(context.device(), setLayout_.get())),
      pipeline_(context.device(), createPipeline(context.device(), layout_.get(), mapped))
{
}

} // namespace nacre
