#version 460
// What any frame costs at least: its inputs read, a colour written, no lighting.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"

layout(constant_id = kConstantModulated) const bool kModulated = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;

layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 colour = texelFetch(normals, pixel, 0).xyz;
    if (kModulated) {
        vec4 albedo = texelFetch(albedos, pixel, 0);
        colour = albedo.w < 255.0 ? colour * albedo.rgb : vec3(0.0);
    }
    code = vec4(colour, 1.0);
}
