#version 460
// Adds a captured surface's residual layer to the radiance that direct.frag left; what falls below 0 is cut where
// radiance is read. engine/scene/reference.cpp is the twin of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/layout.h"

const int kPixelsAtOnce = 1;
#include "residual_input.glsl"

layout(constant_id = kConstantPackedNormals) const bool kPacked = false;
layout(constant_id = kConstantResidualFours) const int kFours = 1;
layout(constant_id = kConstantResidualModulated) const bool kModulated = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(scalar, push_constant) uniform Constants
{
    ResidualConstants constants;
};

layout(location = 0) out vec4 radiance;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy) + ivec2(0, constants.firstRow);
    vec4 normal = texelFetch(normals, pixel, 0);
    bool shown = kPacked ? isPackedNormal(normal.xy) && dot(normal.xy, normal.xy) < 0.5 : normal.w > 0.0 && normal.z > 0.0;
    if (kModulated) {
        shown = shown && int(texelFetch(albedos, pixel, 0).w) < constants.materials;
    }
    if (!shown) {
        discard;
    }
    vec3 sums[kPixelsAtOnce] = {vec3(0.0)};
    int pixels[kPixelsAtOnce] = {pixel.y * constants.width + pixel.x};
    addResidual(sums, pixels, kFours);
    radiance = vec4(sums[0], 0.0);
}
