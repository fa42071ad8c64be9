#version 460
// What any frame costs at least: its inputs read, colours written, no lighting; as many pixels at a time as ball.frag.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/layout.h"

layout(constant_id = kConstantModulated) const bool kModulated = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(scalar, push_constant) uniform Constants
{
    FloorConstants constants;
};

layout(location = 0) out uvec4 codes;

void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy) + ivec2(0, constants.firstRow);
    [[unroll]] for (int p = 0; p < kPixelsPerTexel; ++p) {
        ivec2 pixel = ivec2(min(kPixelsPerTexel * place.x + p, constants.width - 1), place.y);
        vec3 colour = texelFetch(normals, pixel, 0).xyz;
        if (kModulated) {
            vec4 albedo = texelFetch(albedos, pixel, 0);
            colour = albedo.w < 255.0 ? colour * albedo.rgb : vec3(0.0);
        }
        codes[p] = packUnorm4x8(vec4(colour, 1.0));
    }
}
