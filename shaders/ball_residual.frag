#version 460
// The fast path with a residual layer: the ball's exposed radiance (its texels hold the root) plus what the layer knows
// beside it. Draws four pixels in a row, side by side in one texel of the target, so that a gain is fetched once for
// four: on a CPU that takes longer than what is done with it in one pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/layout.h"
#include "shared/tone.h"
#include "ball_input.glsl"

const int kPixelsAtOnce = kPixelsPerTexel;
#include "residual_input.glsl"

layout(constant_id = kConstantBallResidual) const int kFours = 1;

layout(location = 0) out uvec4 codes;

void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy);
    int pixels[kPixelsAtOnce];
    bool shown[kPixelsAtOnce];
    vec3 exposed[kPixelsAtOnce];
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        int x = min(kPixelsAtOnce * place.x + p, constants.width - 1); // the last texel may reach beyond the row
        BallPixel seen = ballPixel(ivec2(x, place.y));
        pixels[p] = place.y * constants.width + x;
        shown[p] = seen.shown;
        exposed[p] = seen.albedo * seen.value * seen.value;
    }
    addResidual(exposed, pixels, kFours);
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        codes[p] = packUnorm4x8(vec4(shown[p] ? displayCode(exposed[p], kToneCurve) : vec3(0.0), 1.0));
    }
}
