#version 460
// The fast path: one lookup of the material's ball, which holds all lights, and what a residual layer adds to it.
// Draws four pixels in a row, side by side in one texel of the target: on a CPU what is done once for all pixels, such
// as fetching a component's gain, takes longer than what is done with it in one.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/layout.h"
#include "shared/tone.h"

const int kPixelsAtOnce = kPixelsPerTexel;
#include "residual_input.glsl"

layout(constant_id = kConstantModulated) const bool kModulated = false;
layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;
layout(constant_id = kConstantBallResidual) const int kFours = 0;

// Balls are the display's codes where pixels add nothing to them; else the square root of exposed radiance.
const bool kBallsAreCodes = !kModulated && kFours == 0;

layout(binding = kBindingBallPlaces) uniform usampler2D places;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingInput) uniform sampler2D balls;
layout(scalar, push_constant) uniform Constants
{
    BallConstants constants;
};

layout(location = 0) out uvec4 codes;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy) + ivec2(0, constants.firstRow);
    uvec4 looks = texelFetch(places, texel, 0);
    int pixels[kPixelsAtOnce];
    vec3 colours[kPixelsAtOnce];
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        int x = min(kPixelsAtOnce * texel.x + p, constants.width - 1); // the last texel may reach beyond the row
        vec3 value = texelFetch(balls, ballTexelOfPlace(looks[p]), 0).rgb;
        vec3 albedo = kModulated ? texelFetch(albedos, ivec2(x, texel.y), 0).rgb : vec3(1.0);
        pixels[p] = texel.y * constants.width + x;
        colours[p] = kBallsAreCodes ? value : albedo * value * value;
    }
    if (kFours > 0) {
        addResidual(colours, pixels, kFours);
    }
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        vec3 code = kBallsAreCodes ? colours[p] : displayCode(colours[p], kToneCurve);
        codes[p] = packUnorm4x8(vec4(looks[p] != kNoBallPlace ? code.bgr : vec3(0.0), 1.0));
    }
}
