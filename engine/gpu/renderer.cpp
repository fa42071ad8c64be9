#include "engine/gpu/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "direct_frag.h"
#include "fullscreen_vert.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array kBindings = {ShaderBinding{kBindingNormals, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                  ShaderBinding{kBindingAlbedo, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                  ShaderBinding{kBindingTable, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER},
                                  ShaderBinding{kBindingLights, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER}};

// Vulkan guarantees 16 KiB of uniform buffer and 256 bytes as the coarsest offset: a pass's lights keep to both.
constexpr VkDeviceSize kLightBytesPerPass = kMaxLightsPerPass * sizeof(GpuLight);
static_assert(kLightBytesPerPass <= 16384 && kLightBytesPerPass % 256 == 0);
static_assert(sizeof(DirectConstants) <= 128, "push constants that every device has");

PassDescription directPass()
{
    return {.vertexShader = fullscreen_vert,
            .fragmentShader = direct_frag,
            .bindings = kBindings,
            .pushConstantBytes = sizeof(DirectConstants),
            .targetFormat = Texture::kFormat};
}

VkExtent3D pictureExtent(const NormalMap& map)
{
    return {static_cast<uint32_t>(map.width), static_cast<uint32_t>(map.height), 1};
}

std::vector<glm::vec4> normalTexels(const NormalMap& map)
{
    std::vector<glm::vec4> texels(map.normals.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        texels[i] = glm::vec4(map.normals[i], map.confidence[i]);
    }
    return texels;
}

std::vector<glm::vec4> albedoTexels(const Surface& surface)
{
    const std::vector<float>& albedo = surface.albedo.values;
    std::vector<glm::vec4> texels(surface.labels.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        const auto label = static_cast<float>(surface.labels[i]);
        texels[i] = albedo.empty() ? glm::vec4(1, 1, 1, label)
                                   : glm::vec4(albedo[3 * i], albedo[3 * i + 1], albedo[3 * i + 2], label);
    }
    return texels;
}

Texture uploadTable(const Context& context, const BrdfTable& table)
{
    std::vector<glm::vec4> texels(table.values.size());
    std::transform(table.values.begin(), table.values.end(), texels.begin(),
                   [](const glm::vec3& f) { return glm::vec4(f, 0); });
    const glm::uvec3 size(table.size);
    return uploadTexture(context, VK_IMAGE_TYPE_3D, {size.x, size.y, size.z}, texels);
}

size_t lightPassCount(size_t lights)
{
    return (lights + kMaxLightsPerPass - 1) / kMaxLightsPerPass;
}

void beginRendering(VkCommandBuffer commands, const Texture& target)
{
    const VkExtent2D size{target.extent().width, target.extent().height};
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = target.view(),
                                          .imageLayout = kDrawnTo.layout,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                          .clearValue = {.color = {.float32 = {0, 0, 0, 1}}}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = {.extent = size},
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{
        .width = static_cast<float>(size.width), .height = static_cast<float>(size.height), .maxDepth = 1};
    const VkRect2D everything{.extent = size};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &everything);
}

// One draw's resources, in the order of kBindings.
struct DirectInputs {
    VkDescriptorImageInfo normals;
    VkDescriptorImageInfo albedo;
    VkDescriptorImageInfo table;
    VkDescriptorBufferInfo lights;
};

VkDescriptorImageInfo sampled(const Sampler& sampler, const Texture& texture)
{
    return {.sampler = sampler.get(), .imageView = texture.view(), .imageLayout = kSampled.layout};
}

void pushInputs(const Context& context, VkCommandBuffer commands, VkPipelineLayout layout, const DirectInputs& inputs)
{
    const std::array images = {&inputs.normals, &inputs.albedo, &inputs.table};
    std::array<VkWriteDescriptorSet, kBindings.size()> writes{};
    for (size_t i = 0; i < writes.size(); ++i) {
        writes[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                     .dstBinding = kBindings[i].binding,
                     .descriptorCount = 1,
                     .descriptorType = kBindings[i].type,
                     .pImageInfo = i < images.size() ? images[i] : nullptr,
                     .pBufferInfo = i < images.size() ? nullptr : &inputs.lights};
    }
    context.pushDescriptorSet(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, writes.size(), writes.data());
}

} // namespace

Renderer::Renderer(const Context& context)
    : context_(context), pipeline_(context, directPass()), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      linear_(makeSampler(context, VK_FILTER_LINEAR))
{
}

void Renderer::setSurface(const Surface& surface)
{
    const VkExtent3D extent = pictureExtent(surface.normals);
    normals_ = uploadTexture(context_, VK_IMAGE_TYPE_2D, extent, normalTexels(surface.normals));
    albedo_ = uploadTexture(context_, VK_IMAGE_TYPE_2D, extent, albedoTexels(surface));
    tables_.clear();
    for (const Material& material : surface.materials) {
        tables_.push_back({uploadTable(context_, material.table), material.table.domain});
    }
    target_ = Texture(context_, VK_IMAGE_TYPE_2D, extent,
                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    readback_ =
        Buffer(context_, size_t{extent.width} * extent.height * sizeof(glm::vec4), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

Frame Renderer::render(const Scene& scene)
{
    setSurface(scene.surface);
    return render(scene.lights, scene.view);
}

Frame Renderer::render(std::span<const Light> lights, const glm::vec3& view)
{
    assert(target_.image() != VK_NULL_HANDLE && "setSurface comes first");
    uploadLights(lights);
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, target_.image(), kUnused, kDrawnTo);
        beginRendering(commands, target_);
        recordPasses(commands, lights.size(), view);
        vkCmdEndRendering(commands);
        imageBarrier(commands, target_.image(), kDrawnTo, kCopiedFrom);
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = target_.extent()};
        vkCmdCopyImageToBuffer(commands, target_.image(), kCopiedFrom.layout, readback_.get(), 1, &copy);
        makeVisibleToHost(commands, readback_);
    });
    return readBack();
}

void Renderer::uploadLights(std::span<const Light> lights)
{
    const VkDeviceSize bytes = std::max<size_t>(1, lightPassCount(lights.size())) * kLightBytesPerPass;
    if (lights_.bytes() < bytes) {
        lights_ = Buffer(context_, bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }
    std::transform(lights.begin(), lights.end(), static_cast<GpuLight*>(lights_.mapped()), [](const Light& light) {
        return GpuLight{glm::vec4(light.direction, 0), glm::vec4(light.irradiance, 0)};
    });
}

// One draw per material and chunk of lights; what they write adds up.
void Renderer::recordPasses(VkCommandBuffer commands, size_t lightCount, const glm::vec3& view) const
{
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
    for (size_t material = 0; material < tables_.size(); ++material) {
        const Table& table = tables_[material];
        const VkExtent3D size = table.texture.extent();
        for (size_t pass = 0; pass < lightPassCount(lightCount); ++pass) {
            pushInputs(context_, commands, pipeline_.layout(),
                       {.normals = sampled(nearest_, normals_),
                        .albedo = sampled(nearest_, albedo_),
                        .table = sampled(linear_, table.texture),
                        .lights = {lights_.get(), pass * kLightBytesPerPass, kLightBytesPerPass}});
            const size_t rest = lightCount - pass * kMaxLightsPerPass;
            const DirectConstants constants{.view = glm::vec4(view, 0),
                                            .tableSize = glm::vec4(size.width, size.height, size.depth, 0),
                                            .domain = table.domain,
                                            .lightCount = static_cast<int>(std::min<size_t>(rest, kMaxLightsPerPass)),
                                            .material = static_cast<int>(material)};
            vkCmdPushConstants(commands, pipeline_.layout(), VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(constants),
                               &constants);
            vkCmdDraw(commands, 3, 1, 0, 0);
        }
    }
}

Frame Renderer::readBack() const
{
    Frame frame(static_cast<int>(target_.extent().width), static_cast<int>(target_.extent().height), 3);
    const auto* texels = static_cast<const glm::vec4*>(readback_.mapped());
    for (size_t i = 0; i < frame.pixelCount(); ++i) {
        for (int c = 0; c < 3; ++c) {
            frame.values[3 * i + c] = texels[i][c];
        }
    }
    return frame;
}

} // namespace nacre
