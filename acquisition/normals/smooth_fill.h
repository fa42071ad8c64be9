#pragma once
#include <cstdint>
#include <span>

#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// Of normals that are a guess: more than no data, less than the confidence of all but hopeless estimates.
constexpr float kSmoothedConfidence = 0.05f;

// Normals of the marked pixels of the object from those around them: each component solves Laplace's equation with the
// normals at the region's border as boundary values, then they are made unit (Wu et al., Image-based BRDF Acquisition
// for Non-spherical Objects, section 4.2, smooths out neighbouring normals where highlights remain). The object's
// outline is no boundary: nothing flows across it. Regions that touch no normal stay without. Answers how many pixels
// were filled.
size_t fillSmoothly(NormalMap& normals, std::span<const uint8_t> marked, std::span<const uint8_t> object);

// The same for a picture of three channels, where (0, 0, 0) is no data.
size_t fillSmoothly(Image& rgb, std::span<const uint8_t> marked, std::span<const uint8_t> object);

} // namespace nacre
