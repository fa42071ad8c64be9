#version 460
// Normals, labels or coordinates as colours, pixel by pixel. engine/scene/false_colour.cpp is the twin on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/ball.h"
#include "shared/layout.h"

layout(constant_id = kConstantModulated) const bool kModulated = false;
layout(constant_id = kConstantShow) const int kShow = kShowNormals;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(scalar, push_constant) uniform Constants
{
    FalseColourConstants constants;
};

layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 packed = texelFetch(normals, pixel, 0).xy;
    int label = kModulated ? int(texelFetch(albedos, pixel, 0).w) : 0;
    vec3 n = normalFromDisc(kPackedReach * packed);
    bool shown = isPackedNormal(packed) && label < constants.materials && dot(n, constants.view.xyz) > 0.0;
    code = vec4(shown ? falseColour(kShow, n, label, constants) : vec3(0.0), 1.0);
}
