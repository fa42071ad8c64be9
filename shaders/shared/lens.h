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

// The picture of a near camera is a distant camera's of another scene: X -> X / (1 - X.z / d), where X counts from
// where the camera's axis meets the plane z = 0 and d is the camera's distance from it. The map is projective, so that
// straight lines stay straight, and what hides what stays. Homogeneous: (place, 1) or (direction, 0), and the image, in
// which a point p sees (x, w) along x - w p.
NACRE_FN vec4 pointInPicture(vec4 viewpoint, vec4 point)
{
    if (viewpoint.w == 0.0f) {
        return point;
    }
    float w = point.w - point.z * viewpoint.w / viewpoint.z;
    vec2 axis = vec2(viewpoint.x, viewpoint.y) / viewpoint.w;
    return vec4(vec2(point.x, point.y) + (w - point.w) * axis, point.z, w);
}

// The unit direction in which the image of a ray leaves that of the place; horizons of the picture's scene are to be
// looked up by it. `l`: unit, of the ray.
NACRE_FN vec3 directionInPicture(vec4 viewpoint, vec3 place, vec3 l)
{
    if (viewpoint.w == 0.0f) {
        return l;
    }
    vec4 from = pointInPicture(viewpoint, vec4(place, 1.0f)), to = pointInPicture(viewpoint, vec4(l, 0.0f));
    return normalize(from.w * vec3(to) - to.w * vec3(from));
}

// Where the ray through a point of the plane z = 0 has that height.
NACRE_FN vec3 placeOnRay(vec4 viewpoint, vec2 onPlane, float height)
{
    float share = height * viewpoint.w / viewpoint.z;
    vec2 axis = viewpoint.w == 0.0f ? onPlane : vec2(viewpoint.x, viewpoint.y) / viewpoint.w;
    return vec3(onPlane + share * (axis - onPlane), height);
}

NACRE_SHARED_END
#endif
