// The reference ball: with v = (0,0,1) and distant lights, radiance depends on the normal alone, so a lit material is
// a picture of a sphere. Its disc of normals fills the square [0,1]^2; row 0 is the top (n.y = +1).
#ifndef NACRE_BALL_H
#define NACRE_BALL_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Unit camera-facing normal to texture coordinates of a ball `size` texels across. Half texels: the disc's rim passes
// through the centres of the border texels.
NACRE_FN vec2 ballTexelFromNormal(vec3 n, float size)
{
    vec2 unit = vec2(0.5f + 0.5f * n.x, 0.5f - 0.5f * n.y);
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
    return vec3(disc.x, disc.y, sqrt(max(0.0f, 1.0f - dot(disc, disc))));
}

NACRE_SHARED_END
#endif
