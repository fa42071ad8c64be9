#pragma once
#include <cstddef>

#include <glm/vec3.hpp>

namespace nacre {

// Which of `materials` an object's point wears whose direction from the object's middle is `direction` (unit): patches
// of some 40 degrees, nearest-point cells around a Fibonacci spiral on the sphere, the materials in turn.
size_t patchMaterial(const glm::dvec3& direction, size_t materials);

} // namespace nacre
