#version 460
// A mesh that was put into the picture's frame already.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/mesh_layout.h"

layout(location = kMeshPoint) in vec3 point;
layout(location = kMeshNormal) in vec3 normal;
layout(location = kMeshTangent) in vec4 tangent;
layout(location = kMeshUv) in vec2 uv;

layout(scalar, push_constant) uniform Constants
{
    MeshConstants constants;
};

layout(location = 0) out float height;
layout(location = 1) out vec3 shadingNormal;
layout(location = 2) out vec4 shadingTangent;
layout(location = 3) out vec2 mapPlace;

void main()
{
    height = point.z;
    shadingNormal = normal;
    shadingTangent = tangent;
    mapPlace = uv;
    float depth = (constants.nearest - point.z) / constants.heightRange;
    gl_Position = vec4(2.0 * point.xy / constants.samples - 1.0, depth, 1.0);
}
