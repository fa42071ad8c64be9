#include "engine/target/mesh_pipeline.h"

#include <array>
#include <cstddef>

#include "engine/gpu/pass.h"
#include "engine/target/depth_buffer.h"
#include "mesh_view_frag.h"
#include "mesh_view_vert.h"
#include "shared/mesh_layout.h"

namespace nacre {

namespace {

VkVertexInputAttributeDescription attribute(int location, VkFormat format, size_t offset)
{
    return {.location = static_cast<uint32_t>(location),
            .binding = 0,
            .format = format,
            .offset = static_cast<uint32_t>(offset)};
}

} // namespace

Pipeline meshPipeline(const Context& context, bool mapped)
{
    static_assert(kConstantMeshMapped == 0, "the first of the constants");
    const std::array constants = {int32_t{mapped}};
    const std::array bindings = {ShaderBinding{kBindingMeshNormalMap, kTextureInput}};
    const std::array attributes = {
        attribute(kMeshPoint, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, point)),
        attribute(kMeshNormal, VK_FORMAT_R32G32B32_SFLOAT, offsetof(MeshVertex, normal)),
        attribute(kMeshTangent, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(MeshVertex, tangent)),
        attribute(kMeshUv, VK_FORMAT_R32G32_SFLOAT, offsetof(MeshVertex, uv))};
    const VertexInput vertices{
        .shader = mesh_view_vert, .stride = sizeof(MeshVertex), .attributes = attributes, .depthFormat = kDepthFormat};
    return Pipeline(context, {.fragmentShader = mesh_view_frag,
                              .constants = constants,
                              .bindings = bindings,
                              .pushConstantBytes = sizeof(MeshConstants),
                              .targetFormat = kFloatFormat,
                              .vertices = &vertices});
}

} // namespace nacre
