// The measurement equation read in both directions, and the display's curve.
#ifndef NACRE_SHADING_H
#define NACRE_SHADING_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Radiance leaving a point: f BRDF [1/sr] without the cosine, E irradiance on a plane that faces the light.
NACRE_FN vec3 radianceFromBrdf(vec3 f, vec3 E, float nDotL)
{
    return f * E * max(nDotL, 0.0f);
}

// The same equation offline. nDotL must be positive; E is positive in every channel.
NACRE_FN vec3 brdfFromRadiance(vec3 radiance, vec3 E, float nDotL)
{
    return radiance / (E * nDotL);
}

// Linear value in [0,1] to its sRGB code value in [0,1] (IEC 61966-2-1).
NACRE_FN float srgbFromLinear(float x)
{
    float c = clamp(x, 0.0f, 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * pow(c, 1.0f / 2.4f) - 0.055f;
}

NACRE_FN float linearFromSrgb(float x)
{
    return x <= 0.04045f ? x / 12.92f : pow((x + 0.055f) / 1.055f, 2.4f);
}

NACRE_SHARED_END
#endif
