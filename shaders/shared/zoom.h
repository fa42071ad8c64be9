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

// What of a picture lies in one pixel of it reduced: pixels [first, end) between two corners.
struct ReducedPixels {
    vec2 low, high;
    ivec2 first, end;
};

// `origin`: top left corner of the reduced part, in pixels of the picture.
NACRE_FN ReducedPixels reducedPixels(vec2 origin, float scale, ivec2 pixel, ivec2 size)
{
    ReducedPixels seen;
    seen.low = max(origin + vec2(pixel) / scale, vec2(0.0f));
    seen.high = min(origin + vec2(pixel + 1) / scale, vec2(size));
    seen.first = ivec2(floor(seen.low));
    seen.end = ivec2(ceil(seen.high));
    return seen;
}

// Share of one of its pixels in the mean.
NACRE_FN float reducedWeight(ReducedPixels seen, ivec2 pixel)
{
    vec2 part = min(seen.high, vec2(pixel + 1)) - max(seen.low, vec2(pixel));
    vec2 all = seen.high - seen.low;
    return part.x * part.y / (all.x * all.y);
}

NACRE_SHARED_END
#endif
