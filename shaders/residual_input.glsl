// What shaders that add a residual layer read, to kPixelsAtOnce pixels. Needs GL_EXT_control_flow_attributes. Buffers of
// texels are what lavapipe (Mesa 22.3) fetches fastest: a texture's fetch looks its mip level up, a uniform buffer's
// numbers are gathered one by one for every lane.
#include "shared/residual.h"

layout(binding = kBindingResidual) uniform usamplerBuffer components; // a pixel's texels side by side, row by row
layout(binding = kBindingResidualWeights) uniform samplerBuffer weights; // ResidualWeights

// Adds the layer's first four * `fours` components to the radiance of the pixels of these numbers.
void addResidual(inout vec3 radiance[kPixelsAtOnce], int pixels[kPixelsAtOnce], int fours)
{
    const int texels = (fours + kFoursPerTexel - 1) / kFoursPerTexel;
    vec3 offset = texelFetch(weights, 0).rgb;
    [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
        radiance[p] += offset;
    }
    [[unroll]] for (int i = 0; i < texels; ++i) {
        uvec4 codes[kPixelsAtOnce];
        [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
            codes[p] = texelFetch(components, pixels[p] * texels + i);
        }
        [[unroll]] for (int four = 0; four < min(kFoursPerTexel, fours - kFoursPerTexel * i); ++four) {
            const int k = 1 + kComponentsPerTexel * i + 4 * four;
            vec4 first = texelFetch(weights, k), second = texelFetch(weights, k + 1);
            vec4 third = texelFetch(weights, k + 2), fourth = texelFetch(weights, k + 3);
            [[unroll]] for (int p = 0; p < kPixelsAtOnce; ++p) {
                radiance[p] += residualOfFour(unpackUnorm4x8(codes[p][four]), first, second, third, fourth);
            }
        }
    }
}
