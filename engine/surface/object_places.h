#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// The bounding box of pixels of a picture so wide: the longer side is the object's width.
struct ObjectExtent {
    glm::dvec2 middle{0}; // image coordinates: x right, y down, whole numbers at the pixels' corners
    double width = 0;     // pixels
};
ObjectExtent extentOf(std::span<const uint32_t> pixels, int width);

// What the object's outline has in the mean: the plane that the middle of a closed object stands on.
float outlineHeight(const NormalMap& normals, const Image& height);

// Where each pixel's point lies, in widths of the object, which is all that has a normal: from the middle of its
// bounding box on the plane of its outline, x right, y up, z towards the camera. On that plane where the surface has no
// height. The surface's places where it has them.
std::vector<glm::vec3> pixelPlaces(const Surface& surface);

bool anyIsNear(std::span<const Light> lights);

// A light as a point at the place meets it, as a distant one; one that is not near stays as it is.
Light lightAt(const Light& light, const glm::vec3& place);

} // namespace nacre
