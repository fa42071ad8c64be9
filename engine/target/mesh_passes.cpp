#include "engine/target/mesh_passes.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <glm/vec4.hpp>

#include "engine/files/parallel_for.h"
#include "engine/surface/surface.h"
#include "engine/target/normal_map_scale.h"
#include "mesh_view_frag.h"
#include "mesh_view_vert.h"
#include "shared/mesh_layout.h"

namespace nacre {
namespace {

constexpr size_t kTrianglesPerUpload = 1 << 17; // 18 MiB of vertices

// One corner of a triangle as shaders/mesh_view.vert reads it.
struct MeshVertex {
    glm::vec3 point;
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};

VkVertexInputAttributeDescription attribute(int location, VkFormat format, size_t offset)
{
    return {.location = static_cast<uint32_t>(location),
            .binding = 0,
            .format = format,
            .offset = static_cast<uint32_t>(offset)};
}

const std::array kAttributes = {attribute(kMeshPoint, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, point)),
                                attribute(kMeshNormal, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, normal)),
                                attribute(kMeshTangent, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(MeshVertex, tangent)),
                                attribute(kMeshUv, VK_FORMAT_R32G32_SFLOAT, offsetof(MeshVertex, uv))};
const VertexInput kVertices{
    .shader = mesh_view_vert, .stride = sizeof(MeshVertex), .attributes = kAttributes, .depthFormat = kDepthFormat};
constexpr std::array kMeshBindings = {ShaderBinding{kBindingMeshNormalMap, kTextureInput}};
static_assert(kConstantMeshMapped == 0 && kConstantMeshPacked == 1);

constexpr ImageUse kDepthTested{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

Texture uploadNormalMap(const Context& context, const NormalMap& map)
{
    std::vector<glm::vec4> texels(map.normals.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        // Where the map has nothing the mesh's own normal stays.
        texels[i] = map.confidence[i] > 0 ? glm::vec4(map.normals[i], 0) : glm::vec4(0, 0, 1, 0);
    }
    const VkExtent3D extent{static_cast<uint32_t>(map.width), static_cast<uint32_t>(map.height), 1};
    return uploadTexture(context, VK_IMAGE_TYPE_2D, extent, kFloatFormat, texels);
}

Texture depthOf(const Context& context, const VkExtent3D& extent)
{
    return {context, {.extent = extent, .format = kDepthFormat, .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}};
}

} // namespace

MeshPasses::MeshPasses(const Context& context, const Mesh& mesh, Draws draws, const Texture& target, int samplesPerSide,
                       const ImageUse& after)
    : context_(context), mesh_(mesh), draws_(draws), target_(target), samplesPerSide_(samplesPerSide), after_(after),
      depth_(depthOf(context, target.extent())),
      vertices_(context,
                3 * std::min(std::max<size_t>(mesh.triangleCount(), 1), kTrianglesPerUpload) * sizeof(MeshVertex),
                VK_BUFFER_USAGE_VERTEX_BUFFER_BIT),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)), noMap_(uploadNormalMap(context, NormalMap(1, 1))),
      pipelines_(context, {.fragmentShader = mesh_view_frag,
                           .bindings = kMeshBindings,
                           .pushConstantBytes = sizeof(MeshConstants),
                           .targetFormat = target.format(),
                           .vertices = &kVertices})
{
}

void MeshPasses::draw(const MeshView& view)
{
    view_ = view;
    if (mapsPixelsPerUnit_ != view.pixelsPerUnit) {
        maps_.clear();
        mapsPixelsPerUnit_ = view.pixelsPerUnit;
    }
    isEmpty_ = true;
    for (size_t part = 0; part < mesh_.parts.size(); ++part) {
        const MeshPart& drawn = mesh_.parts[part];
        const Texture* map = normalMapOf(drawn);
        const size_t label = drawn.isSeen ? std::min<size_t>(part, Surface::kNoMaterial - 1) + 1 : 0;
        for (size_t first = 0; first < drawn.indexCount; first += 3 * kTrianglesPerUpload) {
            const size_t count = std::min(3 * kTrianglesPerUpload, drawn.indexCount - first);
            fillVertices(drawn.firstIndex + first, count);
            context_.run([&](VkCommandBuffer commands) {
                record(commands, static_cast<uint32_t>(count), static_cast<float>(label), map);
            });
            isEmpty_ = false;
        }
    }
}

// Null: the part has none. Maps of several parts are uploaded once, at the size at which they are seen.
const Texture* MeshPasses::normalMapOf(const MeshPart& part)
{
    if (!part.normalMap) {
        return nullptr;
    }
    const auto [at, isNew] = maps_.try_emplace(part.normalMap.get());
    if (isNew) {
        const double samplesPerUnit = view_.pixelsPerUnit * samplesPerSide_;
        at->second = uploadNormalMap(context_, seenNormalMap(mesh_, part, samplesPerUnit));
    }
    return &at->second;
}

void MeshPasses::fillVertices(size_t firstIndex, size_t count)
{
    auto* vertices = static_cast<MeshVertex*>(vertices_.mapped());
    const glm::mat3 turn(view_.turn);
    parallelFor(count, 1 << 14, 0, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const uint32_t v = mesh_.indices[firstIndex + i];
            const glm::dvec3 p = view_.pixelPoint(mesh_.positions[v]);
            MeshVertex vertex{{samplesPerSide_ * p.x, samplesPerSide_ * p.y, p.z}, turn * mesh_.normals[v], {}, {}};
            if (!mesh_.tangents.empty()) {
                const glm::vec4& tangent = mesh_.tangents[v];
                vertex.tangent = glm::vec4(turn * glm::vec3(tangent), tangent.w);
            }
            if (!mesh_.uvs.empty()) {
                vertex.uv = mesh_.uvs[v];
            }
            vertices[i] = vertex;
        }
    });
}

void MeshPasses::beginDrawing(VkCommandBuffer commands)
{
    imageBarrier(commands, target_.image(), isEmpty_ ? kUnused : after_, kDrawnTo);
    imageBarrier(commands, depth_.image(), isEmpty_ ? kUnused : kDepthTested, kDepthTested, VK_IMAGE_ASPECT_DEPTH_BIT);
    const VkAttachmentLoadOp load = isEmpty_ ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    const float nothing = draws_ == Draws::packedNormals ? 1.0f : 0.0f;
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = target_.view(),
                                          .imageLayout = kDrawnTo.layout,
                                          .loadOp = load,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                          .clearValue = {.color = {.float32 = {nothing, nothing, 0, 0}}}};
    const VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = depth_.view(),
                                          .imageLayout = kDepthTested.layout,
                                          .loadOp = load,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                          .clearValue = {.depthStencil = {.depth = 1}}};
    const VkExtent3D extent = target_.extent();
    const VkRect2D area{.extent = {extent.width, extent.height}};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = area,
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color,
                               .pDepthAttachment = &depth};
    vkCmdBeginRendering(commands, &info);
    const VkViewport viewport{
        .width = static_cast<float>(extent.width), .height = static_cast<float>(extent.height), .maxDepth = 1};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &area);
}

void MeshPasses::record(VkCommandBuffer commands, uint32_t vertexCount, float label, const Texture* map)
{
    // A little beyond the nearest and the farthest, which rounding would clip.
    const auto reach = static_cast<float>(1.001 * (view_.nearest - view_.farthest) + 1);
    const MeshConstants constants{{target_.extent().width, target_.extent().height},
                                  static_cast<float>(view_.nearest) + 0.0005f * reach,
                                  1.001f * reach,
                                  static_cast<float>(samplesPerSide_),
                                  label,
                                  mesh_.front ? static_cast<float>(mesh_.front->normals.width) : 0.0f};
    const Pipeline& pipeline = pipelines_.with({map != nullptr, draws_ == Draws::packedNormals});
    beginDrawing(commands);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
    const ShaderInput input = textureInput(kBindingMeshNormalMap, nearest_, map ? *map : noMap_);
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstBinding = input.binding,
                                     .descriptorCount = 1,
                                     .descriptorType = kTextureInput,
                                     .pImageInfo = &input.image};
    context_.pushDescriptorSet(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.layout(), 0, 1, &write);
    vkCmdPushConstants(commands, pipeline.layout(), pipeline.constantStages(), 0, sizeof(constants), &constants);
    const VkBuffer buffer = vertices_.get();
    const VkDeviceSize offset = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &buffer, &offset);
    vkCmdDraw(commands, vertexCount, 1, 0, 0);
    vkCmdEndRendering(commands);
    imageBarrier(commands, target_.image(), kDrawnTo, after_);
}

} // namespace nacre
