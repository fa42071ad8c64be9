#pragma once
#include <span>

#include "engine/brdf/brdf_models.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// Linear radiance of a ball of the material that fills a square picture, seen from the front, black around it. The
// model is asked itself, so that a small picture needs no table.
Image materialBall(const BrdfModel& model, std::span<const Light> lights, int size, int threads = 0);

// How lists show a material: under the key light in dim even surroundings, which come as the directional albedo, so
// that the highlights of mirrors are not those of single lights.
Image materialThumbnail(const BrdfModel& model, int size);

} // namespace nacre
