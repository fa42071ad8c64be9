#version 460
// Where in the balls of ball.frag each pixel looks: it does not depend on the light, and is drawn once.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/layout.h"

layout(constant_id = kConstantModulated) const bool kModulated = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(scalar, push_constant) uniform Constants
{
    BallPlacesConstants constants;
};

layout(location = 0) out uvec4 places;

uint ballPlace(ivec2 pixel)
{
    vec2 packed = texelFetch(normals, pixel, 0).xy;
    ivec2 texel = nearestBallTexelOfPacked(packed, constants.size);
    bool shown = dot(packed, packed) < 0.5; // what faces away, and what says that there is no normal, lies beyond
    if (kModulated) {
        int material = int(texelFetch(albedos, pixel, 0).w);
        shown = shown && material < constants.materials;
        int row = material / constants.columns;
        texel += constants.size * ivec2(material - row * constants.columns, row);
    }
    return shown ? packedBallPlace(texel) : kNoBallPlace;
}

void main()
{
    ivec2 place = ivec2(gl_FragCoord.xy);
    [[unroll]] for (int p = 0; p < kPixelsPerTexel; ++p) {
        int x = min(kPixelsPerTexel * place.x + p, constants.width - 1); // the last texel may reach beyond the row
        places[p] = ballPlace(ivec2(x, place.y));
    }
}
