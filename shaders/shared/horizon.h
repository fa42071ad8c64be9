// Cast shadows by horizon mapping (Max, Horizon mapping: shadows for bump-mapped surfaces, 1988; Sloan, Cohen,
// Interactive Horizon Mapping, 2000): for some azimuths each pixel knows the elevation above which the sky is free.
#ifndef NACRE_HORIZON_H
#define NACRE_HORIZON_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Eight bits a horizon: the sine of its elevation, from kLowestHorizon (-8 degrees) to 1. Surfaces that fall away have
// horizons below 0, so that lights from behind still reach their rims; what lies deeper is the lowest.
const float kHorizonSteps = 223.0f; // of the code, from the sine 0 to 1
const float kFlatHorizon = 32.0f;   // code of the sine 0, exact
const float kLowestHorizon = -kFlatHorizon / kHorizonSteps;

// From dark to lit in sines: two steps, about half a degree of elevation, which is the sun's own diameter. Rounding a
// horizon moves it by a quarter of that.
const float kPenumbra = 2.0f / kHorizonSteps;
// Keeps a light straight above out of the penumbra of a vertical wall.
const float kHighestHorizon = 1.0f - kPenumbra;

// One light: x and y the layers of the neighbouring azimuths, z the share of the second, w the sine of its elevation.
// `azimuths` are even, layer k at 2 pi k / azimuths from +x to +y. Lights lower than any horizon count as grazing it.
NACRE_FN vec4 horizonLookup(vec3 l, int azimuths)
{
    bool overhead = l.x == 0.0f && l.y == 0.0f;
    float turn = overhead ? 0.0f : fract(atan(l.y, l.x) / (2.0f * kPi));
    float place = turn * float(azimuths);
    int layer = min(int(place), azimuths - 1);
    int next = layer + 1 < azimuths ? layer + 1 : 0;
    return vec4(float(layer), float(next), place - float(layer), max(l.z, kLowestHorizon + kPenumbra));
}

NACRE_FN float horizonFromCode(float code)
{
    return (code - kFlatHorizon) / kHorizonSteps;
}

NACRE_FN float codeFromHorizon(float sine)
{
    return clamp(sine, kLowestHorizon, kHighestHorizon) * kHorizonSteps + kFlatHorizon;
}

// Share of the light that arrives, from the codes (0 to 255) of the two layers.
NACRE_FN float visibility(vec4 lookup, float code, float nextCode)
{
    float horizon = mix(horizonFromCode(code), horizonFromCode(nextCode), lookup.z);
    float s = clamp((lookup.w - horizon) / kPenumbra + 0.5f, 0.0f, 1.0f);
    return s * s * (3.0f - 2.0f * s);
}

NACRE_SHARED_END
#endif
