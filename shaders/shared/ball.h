// The reference ball: with v = (0,0,1) and distant lights, radiance depends on the normal alone, so a lit material is
// a picture of a hemisphere of normals. It is projected with equal areas (Lambert azimuthal): the orthographic picture
// of a sphere crowds all grazing normals into its rim, where radiance changes fastest. The disc of normals fills the
// square [0,1]^2; row 0 is the top (n.y = +1).
#ifndef NACRE_BALL_H
#define NACRE_BALL_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Unit normal to the disc: the horizon lies on the unit circle, what faces away on the ring around it, up to the radius
// sqrt(2). |disc|^2 = 1 - z.
NACRE_FN vec2 discFromNormal(vec3 n)
{
    return vec2(n.x, n.y) * inversesqrt(max(1.0f + n.z, 1e-6f));
}

NACRE_FN vec3 normalFromDisc(vec2 disc)
{
    float square = dot(disc, disc);
    vec2 xy = disc * sqrt(max(0.0f, 2.0f - square));
    return vec3(xy.x, xy.y, 1.0f - square);
}

// A normal in two numbers of [-1, 1]; (1, 1) lies outside of the ring and says that there is none.
const float kPackedReach = 1.41421356f;

NACRE_FN vec2 packedFromNormal(vec3 n)
{
    return discFromNormal(n) / kPackedReach;
}

NACRE_FN bool isPackedNormal(vec2 packed)
{
    return dot(packed, packed) < 1.5f;
}

// Unit camera-facing normal to texture coordinates of a ball `size` texels across. Half texels: the disc's rim passes
// through the centres of the border texels.
NACRE_FN vec2 ballTexelFromNormal(vec3 n, float size)
{
    vec2 disc = discFromNormal(n);
    vec2 unit = vec2(0.5f + 0.5f * disc.x, 0.5f - 0.5f * disc.y);
    return (unit * (size - 1.0f) + 0.5f) / size;
}

// The inverse; texture coordinates beyond the rim give the rim's nearest normal, so that filtering never reads black.
NACRE_FN vec3 normalFromBallTexel(vec2 texel, float size)
{
    vec2 unit = (texel * size - 0.5f) / (size - 1.0f);
    vec2 disc = vec2(2.0f * unit.x - 1.0f, 1.0f - 2.0f * unit.y);
    float radius = length(disc);
    if (radius > 1.0f) {
        disc = disc / radius;
    }
    return normalFromDisc(disc);
}

// Column and row of the texel nearest to a place on the disc.
NACRE_FN ivec2 nearestBallTexel(vec2 disc, int size)
{
    float reach = 0.5f * float(size - 1);
    return ivec2(vec2(disc.x, -disc.y) * reach + vec2(reach + 0.5f));
}

// The same for discFromNormal / kPackedReach.
NACRE_FN ivec2 nearestBallTexelOfPacked(vec2 packed, int size)
{
    float reach = 0.5f * kPackedReach * float(size - 1);
    return ivec2(vec2(packed.x, -packed.y) * reach + vec2(0.5f * float(size)));
}

// A ball that pixels read filtered holds the mean of f over the lights, each counting by this: radiance has a crease
// where a light sets, which filtering smooths. Lights that have set count a little, so that every normal has a mean.
NACRE_FN vec3 shareInMean(vec3 irradiance, float nDotL)
{
    return irradiance * max(nDotL, 0.001f);
}

// A texel of balls that lie side by side, in one number; none where a pixel shows nothing. Its texel is one of a ball
// all the same, which is read and not shown.
const uint kNoBallPlace = 0x80000000u;

NACRE_FN uint packedBallPlace(ivec2 texel)
{
    return uint(texel.x) | uint(texel.y) << 16;
}

NACRE_FN ivec2 ballTexelOfPlace(uint place)
{
    return ivec2(int(place & 0xFFFFu), int(place >> 16 & 0x7FFFu));
}

// Texture coordinates of the same place in a ball of another size.
NACRE_FN vec2 resizedBallTexel(vec2 texel, float size, float otherSize)
{
    return ((texel * size - 0.5f) * ((otherSize - 1.0f) / (size - 1.0f)) + 0.5f) / otherSize;
}

NACRE_SHARED_END
#endif
