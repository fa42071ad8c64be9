// Pictures at another scale than their own.
#ifndef NACRE_ZOOM_H
#define NACRE_ZOOM_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Means are of light. What a code emits is near to its square (sRGB's curve is), whose mean leaves even areas as they
// are.
NACRE_FN vec3 lightOfCode(vec3 code)
{
    return code * code;
}

NACRE_FN vec3 codeOfLight(vec3 light)
{
    return sqrt(light);
}

// Share of a pixel that an object covers, from the share of the place's neighbours (bilinear) that it has: the outline
// is where that is a half, and as wide as a pixel.
NACRE_FN float coverOfPixel(float neighbours, float scale)
{
    return clamp(0.5f + (neighbours - 0.5f) * scale, 0.0f, 1.0f);
}

// Along one axis, the border before a pixel of a picture reduced, in pixels of the picture, of which there are `count`.
// `origin`: that of the reduced part.
NACRE_FN float borderOfReduced(float origin, float scale, int pixel, int count)
{
    return clamp(origin + float(pixel) / scale, 0.0f, float(count));
}

// Share of what lies between two borders that one of the picture's pixels has.
NACRE_FN float shareOfReduced(float low, float high, int pixel)
{
    return max(min(high, float(pixel + 1)) - max(low, float(pixel)), 0.0f) / (high - low);
}

// Pixels that a reduced one meets at most.
NACRE_FN int reachOfReduced(float scale)
{
    return int(1.0f / scale) + 2;
}

NACRE_SHARED_END
#endif
