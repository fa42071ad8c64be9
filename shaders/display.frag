#version 460
// Radiance to the display's codes, hatched where its alpha says so.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"
#include "shared/tone.h"

layout(constant_id = kConstantHatched) const bool kHatched = false;
layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;

layout(binding = kBindingInput) uniform sampler2D radiance;
layout(scalar, push_constant) uniform Constants
{
    DisplayConstants constants;
};

layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 light = texelFetch(radiance, pixel - ivec2(0, constants.firstRow), 0);
    vec3 shown = displayCode(constants.gain * light.rgb, kToneCurve);
    bool hatch = kHatched && light.w > 0.0;
    code = vec4(hatch ? hatched(shown, pixel) : shown, 1.0);
}
