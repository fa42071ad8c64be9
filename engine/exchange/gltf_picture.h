#pragma once
#include <span>

#include "engine/exchange/gltf_surface.h"
#include "engine/lights/light.h"

namespace nacre {

// Radiance of gltfSurface(surface, ...) from the front, by glTF's own formulas from the scene's factors and textures as
// they are stored. Lights reach the pixels as they do those of the surface, shadows included. Textures are of the
// surface's size.
Image gltfPicture(const GltfScene& scene, const Surface& surface, std::span<const Light> lights);

} // namespace nacre
