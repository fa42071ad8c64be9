#version 460
// A picture at another scale: magnified, its codes are there already and the outline is drawn; reduced, they are averaged.
// engine/surface/zoom.cpp is the twin of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"
#include "shared/zoom.h"

layout(constant_id = kConstantMagnified) const bool kMagnified = false;

layout(binding = kBindingInput) uniform sampler2D picture;
layout(binding = kBindingCover) uniform sampler2DArray cover; // of one layer
layout(scalar, push_constant) uniform Constants
{
    ZoomConstants constants;
};

layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 light = vec3(0.0);
    if (kMagnified) {
        light = texelFetch(cover, ivec3(pixel, 0), 0).r * lightOfCode(texelFetch(picture, pixel, 0).rgb);
    } else {
        ReducedPixels seen = reducedPixels(constants.origin, constants.scale, pixel, textureSize(picture, 0));
        for (int row = seen.first.y; row < seen.end.y; ++row) {
            for (int column = seen.first.x; column < seen.end.x; ++column) {
                ivec2 at = ivec2(column, row);
                light += reducedWeight(seen, at) * lightOfCode(texelFetch(picture, at, 0).rgb);
            }
        }
    }
    code = vec4(codeOfLight(light), 1.0);
}
