#version 460
// The fast path: one lookup of the material's ball, which holds all lights. Plain balls are already the display's
// codes; modulated ones hold the square root of exposed radiance, to be multiplied by the pixel's albedo factor and
// added to what a residual layer knows beside it.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/tone.h"
#include "residual_input.glsl"

layout(constant_id = kConstantModulated) const bool kModulated = false;
layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;

layout(constant_id = kConstantBallResidual) const int kResidualLayers = 0;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingInput) uniform sampler2D balls;
layout(scalar, push_constant) uniform Constants
{
    BallConstants constants;
};

layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 packed = texelFetch(normals, pixel, 0).xy;
    ivec2 texel = nearestBallTexelOfPacked(packed, constants.size);
    bool shown = dot(packed, packed) < 0.5; // what faces away, and what says that there is no normal, lies beyond
    vec3 colour;
    if (kModulated) {
        vec4 albedo = texelFetch(albedos, pixel, 0);
        int material = min(int(albedo.w), constants.materials - 1);
        shown = shown && int(albedo.w) < constants.materials;
        int row = int((float(material) + 0.5) / constants.columns);
        texel += constants.size * ivec2(material - row * int(constants.columns), row);
        vec3 root = texelFetch(balls, texel, 0).rgb;
        vec3 exposed = albedo.rgb * root * root;
        if (kResidualLayers > 0) {
            exposed += residualOfPixel(pixel, kResidualLayers);
        }
        colour = displayCode(exposed, kToneCurve);
    } else {
        colour = texelFetch(balls, texel, 0).rgb;
    }
    code = vec4(shown ? colour : vec3(0.0), 1.0);
}
