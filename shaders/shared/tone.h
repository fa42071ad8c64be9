// From linear radiance to code values of the display.
#ifndef NACRE_TONE_H
#define NACRE_TONE_H
#include "glsl.h"
NACRE_SHARED_BEGIN

const int kToneSrgb = 0;   // clipped at 1, then sRGB's curve
const int kToneFilmic = 1; // a shoulder and a toe before it

// sRGB's curve (IEC 61966-2-1) without pow: least squares in roots of x, off by at most 0.1 of an 8-bit code.
NACRE_FN float fastSrgbFromLinear(float x)
{
    float c = clamp(x, 0.0f, 1.0f);
    float s = sqrt(c);
    float curve = 0.833681548f * s + 0.298174757f * sqrt(s) - 0.0552974658f * c - 0.0769192075f;
    return c <= 0.0031308f ? 12.92f * c : curve;
}

// Narkowicz, ACES Filmic Tone Mapping Curve, 2016: a fit of the reference transform.
NACRE_FN float filmicFromLinear(float x)
{
    return clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

NACRE_FN vec3 displayCode(vec3 exposed, int toneCurve)
{
    vec3 c = max(exposed, vec3(0.0f));
    if (toneCurve == kToneFilmic) {
        c = vec3(filmicFromLinear(c.x), filmicFromLinear(c.y), filmicFromLinear(c.z));
    }
    return vec3(fastSrgbFromLinear(c.x), fastSrgbFromLinear(c.y), fastSrgbFromLinear(c.z));
}

NACRE_SHARED_END
#endif
