#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/gpu/pipeline.h"

namespace nacre {

// One corner of a triangle as shaders/mesh_view.vert reads it.
struct MeshVertex {
    glm::vec3 point;
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};

// Draws triangles of MeshVertex with shaders/mesh_view.{vert,frag} into kFloatFormat and kDepthFormat. `mapped`: with a
// normal map.
Pipeline meshPipeline(const Context& context, bool mapped);

} // namespace nacre
