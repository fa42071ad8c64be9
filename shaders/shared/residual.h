// What a captured surface shows beyond its BRDF: a weighted sum of component pictures, whose weights depend on the
// lights alone.
#ifndef NACRE_RESIDUAL_H
#define NACRE_RESIDUAL_H
#include "glsl.h"
NACRE_SHARED_BEGIN

const int kComponentsPerTexel = 16; // a byte each of four 32-bit integers
const int kFoursPerTexel = kComponentsPerTexel / 4;
const int kMostResidualLayers = 4; // of texels

// The weights under the lights of one frame, which shaders read as texels.
struct ResidualWeights {
    vec4 offset;                                           // RGB radiance of codes 0
    vec4 gains[kMostResidualLayers * kComponentsPerTexel]; // RGB radiance of each component's code 1 above it
};

// Of four components: codes in [0, 1].
NACRE_FN vec3 residualOfFour(vec4 codes, vec4 first, vec4 second, vec4 third, vec4 fourth)
{
    return codes.x * vec3(first) + codes.y * vec3(second) + codes.z * vec3(third) + codes.w * vec3(fourth);
}

NACRE_SHARED_END
#endif
