// Lights that stand near the object.
#ifndef NACRE_NEAR_LIGHT_H
#define NACRE_NEAR_LIGHT_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// A light as a point meets it: xyz the unit direction towards it, w its irradiance over that at the object's middle,
// which falls off with the square of the distance. `direction` (unit) and `nearness` (1 / distance, 0 of a distant
// light) are those from the middle, `place` is the point's from there, in the unit of the distance.
NACRE_FN vec4 lightFromPlace(vec3 direction, float nearness, vec3 place)
{
    vec3 towards = direction - nearness * place;
    float square = dot(towards, towards);
    return vec4(towards * inversesqrt(square), 1.0f / square);
}

NACRE_SHARED_END
#endif
