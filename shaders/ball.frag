#version 460
// The fast path: one lookup of the material's ball, which holds all lights. Plain balls are already the display's
// codes; modulated ones hold the square root of exposed radiance, to be multiplied by the pixel's albedo factor.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/ball.h"
#include "shared/layout.h"
#include "shared/tone.h"
#include "ball_input.glsl"

layout(location = 0) out vec4 code;

void main()
{
    BallPixel seen = ballPixel(ivec2(gl_FragCoord.xy));
    vec3 colour = kModulated ? displayCode(seen.albedo * seen.value * seen.value, kToneCurve) : seen.value;
    code = vec4(seen.shown ? colour : vec3(0.0), 1.0);
}
