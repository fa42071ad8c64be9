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

// Pixels along one axis of which a reduced one is the mean: all that it meets, or as many that are spread evenly.
const int kMostReach = 8;

NACRE_FN int reachOfReduced(float scale)
{
    return min(int(min(1.0f / scale, float(kMostReach))) + 2, kMostReach);
}

// The k-th of them between two borders: x the pixel, y its share.
NACRE_FN vec2 pixelOfReduced(float low, float high, int k, int reach)
{
    if (high - low > float(reach - 1)) {
        return vec2(floor(low + (float(k) + 0.5f) * (high - low) / float(reach)), 1.0f / float(reach));
    }
    float pixel = floor(low) + float(k);
    return vec2(pixel, max(min(high, pixel + 1.0f) - max(low, pixel), 0.0f) / (high - low));
}

NACRE_SHARED_END
#endif
