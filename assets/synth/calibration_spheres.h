#pragma once
#include <cstdint>
#include <vector>

#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// Spheres that stand beside the object under the same lights, in a square picture of their own.

// Share of the picture's side that the sphere's diameter takes.
constexpr double kSphereShare = 0.94;

std::vector<uint8_t> calibrationSphereMask(int size);

// Radiance of a Lambertian sphere, sampled at the pixels' centres.
Image diffuseSphereRadiance(int size, const glm::vec3& reflectance, const Light& light);

// Radiance of a mirror sphere: the light's small disc, far brighter than any photograph's full scale, over a dim room.
Image mirrorSphereRadiance(int size, const Light& light, double roomRadiance);

} // namespace nacre
