// Lets one header be read as GLSL and as C++: GLM supplies GLSL's types and functions to C++.
#ifndef NACRE_GLSL_H
#define NACRE_GLSL_H

#ifdef __cplusplus
#include <glm/glm.hpp>
#define NACRE_SHARED_BEGIN namespace nacre {
#define NACRE_SHARED_END }
#define NACRE_FN inline
NACRE_SHARED_BEGIN
using glm::abs;
using glm::acos;
using glm::atan;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::fract;
using glm::inversesqrt;
using glm::ivec2;
using glm::ivec3;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::sin;
using glm::sqrt;
using glm::tan;
using glm::uint;
using glm::vec2;
using glm::vec3;
using glm::vec4;
NACRE_SHARED_END
#else
#define NACRE_SHARED_BEGIN
#define NACRE_SHARED_END
#define NACRE_FN
#endif

NACRE_SHARED_BEGIN
const float kPi = 3.14159265358979f;
const float kHalfPi = 1.57079632679490f;
NACRE_SHARED_END

#endif
