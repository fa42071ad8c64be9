// What shaders that add a residual layer read. Needs GL_EXT_control_flow_attributes and scalar layout.
#include "shared/layout.h"
#include "shared/residual.h"

layout(binding = kBindingResidual) uniform usampler2DArray components;
layout(scalar, binding = kBindingResidualWeights) uniform Weights
{
    ResidualWeights weights;
};

vec3 residualOfPixel(ivec2 pixel, int layers)
{
    vec3 sum = weights.offset.rgb;
    [[unroll]] for (int i = 0; i < layers; ++i) {
        uvec4 texel = texelFetch(components, ivec3(pixel, i), 0);
        [[unroll]] for (int four = 0; four < kComponentsPerTexel / 4; ++four) {
            const int k = i * kComponentsPerTexel + 4 * four;
            sum += residualOfFour(unpackUnorm4x8(texel[four]), weights.gains[k], weights.gains[k + 1],
                                  weights.gains[k + 2], weights.gains[k + 3]);
        }
    }
    return sum;
}
