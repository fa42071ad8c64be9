#version 460
// The input as it is, pixel by pixel: with an adding pipeline, the sum of pictures.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"

layout(binding = kBindingInput) uniform sampler2D picture;

layout(location = 0) out vec4 value;

void main()
{
    value = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
