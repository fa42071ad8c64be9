// The camera of a captured surface where it stands near.
#ifndef NACRE_LENS_H
#define NACRE_LENS_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// A viewpoint: xyz the unit direction towards it from the object's middle, w 1 / its distance, 0 of a distant one.
// Places are points from the middle, in the unit of the distance.

// Unit, from a place towards the viewpoint.
NACRE_FN vec3 viewFromPlace(vec4 viewpoint, vec3 place)
{
    return viewpoint.w == 0.0f ? vec3(viewpoint) : normalize(vec3(viewpoint) - viewpoint.w * place);
}

// The picture of a near camera is a distant camera's of another scene: X -> X / s with s = 1 - X.z / d, where X counts
// from where the camera's axis meets the plane z = 0 and d is the camera's distance from it. The map is projective, so
// that straight lines stay straight, and what hides what stays. The ray from X along l leaves its image along
//     d/dt [(X + t l) / (s - t l.z / d)] at t = 0   ~   s l + (l.z / d) X.
// Unit; horizons of the picture's scene are to be looked up by it.
NACRE_FN vec3 directionInPicture(vec4 viewpoint, vec3 place, vec3 l)
{
    if (viewpoint.w == 0.0f) {
        return l;
    }
    float nearness = viewpoint.w / viewpoint.z; // 1 / d
    vec3 fromAxis = nearness * place - vec3(viewpoint.x, viewpoint.y, 0.0f) / viewpoint.z;
    return normalize((1.0f - nearness * place.z) * l + l.z * fromAxis);
}

// Where the ray through a point of the plane z = 0 has that height.
NACRE_FN vec3 placeOnRay(vec4 viewpoint, vec2 onPlane, float height)
{
    float share = height * viewpoint.w / viewpoint.z;
    vec2 axis = viewpoint.w == 0.0f ? onPlane : vec2(viewpoint.x, viewpoint.y) / viewpoint.w;
    return vec3(onPlane + share * (axis - onPlane), height);
}

// Height of a point's image in the picture's scene, in the unit of the distances.
NACRE_FN float heightInPicture(vec4 viewpoint, float height)
{
    return height / (1.0f - height * viewpoint.w / viewpoint.z);
}

NACRE_SHARED_END
#endif
