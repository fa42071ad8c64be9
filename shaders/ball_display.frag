#version 460
// Stretches a radiance ball to the size at which the nearest texel is good enough, exposed and encoded: as codes of the
// display, or as the square root of exposed radiance where pixels have albedo factors (half floats then keep 3 digits of
// it in every range, and the root is where the eye's steps are even).
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/ball.h"
#include "shared/layout.h"
#include "shared/tone.h"

layout(constant_id = kConstantModulated) const bool kModulated = false;
layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;

layout(binding = kBindingInput) uniform sampler2D radiance;
layout(scalar, push_constant) uniform Constants
{
    BallDisplayConstants constants;
};

layout(location = 0) out vec4 value;

void main()
{
    vec2 texel = (gl_FragCoord.xy - constants.origin) / constants.size;
    vec2 place = resizedBallTexel(texel, constants.size, constants.inputSize);
    vec3 exposed = constants.gain * textureLod(radiance, place, 0.0).rgb;
    value = vec4(kModulated ? sqrt(max(exposed, vec3(0.0))) : displayCode(exposed, kToneCurve), 1.0);
}
