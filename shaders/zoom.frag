#version 460
// A picture at another scale: magnified, its codes are there already and the outline is drawn; reduced, they are averaged.
// engine/surface/zoom.cpp is the twin of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/layout.h"
#include "shared/zoom.h"

layout(constant_id = kConstantReach) const int kReach = 0; // 0: magnified

layout(binding = kBindingInput) uniform sampler2D picture;
layout(binding = kBindingCover) uniform sampler2DArray cover; // of one layer
layout(scalar, push_constant) uniform Constants
{
    ZoomConstants constants;
};

layout(location = 0) out vec4 code;

vec3 meanLight(ivec2 pixel)
{
    ivec2 size = textureSize(picture, 0);
    float left = borderOfReduced(constants.origin.x, constants.scale, pixel.x, size.x);
    float right = borderOfReduced(constants.origin.x, constants.scale, pixel.x + 1, size.x);
    float top = borderOfReduced(constants.origin.y, constants.scale, pixel.y, size.y);
    float bottom = borderOfReduced(constants.origin.y, constants.scale, pixel.y + 1, size.y);
    vec3 light = vec3(0.0);
    [[unroll]] for (int i = 0; i < kReach; ++i) {
        vec2 row = pixelOfReduced(top, bottom, i, kReach);
        [[unroll]] for (int j = 0; j < kReach; ++j) {
            vec2 column = pixelOfReduced(left, right, j, kReach);
            ivec2 at = min(ivec2(int(column.x), int(row.x)), size - 1); // beyond, shares are 0
            light += row.y * column.y * lightOfCode(texelFetch(picture, at, 0).rgb);
        }
    }
    return light;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 light = vec3(0.0);
    if (kReach > 0) {
        light = meanLight(pixel);
    } else {
        light = texelFetch(cover, ivec3(pixel, 0), 0).r * lightOfCode(texelFetch(picture, pixel, 0).rgb);
    }
    code = vec4(codeOfLight(light), 1.0);
}
