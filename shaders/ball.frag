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

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingInput) uniform sampler2D balls;
layout(scalar, push_constant) uniform Constants
{
    BallConstants constants;
};

layout(location = 0) out uvec4 codes;

struct BallPixel {
    bool shown;  // false where nothing is to be seen: albedo and value mean nothing then
    vec3 albedo; // factor
    vec3 value;  // of the ball's nearest texel
};

BallPixel ballPixel(ivec2 pixel)
{
    BallPixel seen;
    vec2 packed = texelFetch(normals, pixel, 0).xy;
    ivec2 texel = nearestBallTexelOfPacked(packed, constants.size);
    seen.shown = dot(packed, packed) < 0.5; // what faces away, and what says that there is no normal, lies beyond
    seen.albedo = vec3(1.0);
    if (kModulated) {
        vec4 albedo = texelFetch(albedos, pixel, 0);
        int material = min(int(albedo.w), constants.materials - 1);
        seen.shown = seen.shown && int(albedo.w) < constants.materials;
        seen.albedo = albedo.rgb;
        int row = int((float(material) + 0.5) / constants.columns);
        texel += constants.size * ivec2(material - row * int(constants.columns), row);
    }
    seen.value = texelFetch(balls, texel, 0).rgb;
    return seen;
}

void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy) + ivec2(0, constants.firstRow);
    int pixels[kPixelsAtOnce];
    bool shown[kPixelsAtOnce];
    vec3 colours[kPixelsAtOnce];
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        int x = min(kPixelsAtOnce * place.x + p, constants.width - 1); // the last texel may reach beyond the row
        BallPixel seen = ballPixel(ivec2(x, place.y));
        pixels[p] = place.y * constants.width + x;
        shown[p] = seen.shown;
        colours[p] = kBallsAreCodes ? seen.value : seen.albedo * seen.value * seen.value;
    }
    if (kFours > 0) {
        addResidual(colours, pixels, kFours);
    }
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        vec3 code = kBallsAreCodes ? colours[p] : displayCode(colours[p], kToneCurve);
        codes[p] = packUnorm4x8(vec4(shown[p] ? code : vec3(0.0), 1.0));
    }
}
