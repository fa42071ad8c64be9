#version 460
// Radiance to the display's codes.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"
#include "shared/tone.h"

layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;

layout(binding = kBindingInput) uniform sampler2D radiance;
layout(scalar, push_constant) uniform Constants
{
    DisplayConstants constants;
};

layout(location = 0) out vec4 code;

void main()
{
    vec3 exposed = constants.gain * texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb;
    code = vec4(displayCode(exposed, kToneCurve), 1.0);
}
