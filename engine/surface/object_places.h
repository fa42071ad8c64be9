#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// The bounding box of pixels of a picture so wide: the longer side is the object's width.
struct ObjectExtent {
    glm::dvec2 middle{0}; // image coordinates: x right, y down, whole numbers at the pixels' corners
    double width = 0;     // pixels
};
ObjectExtent extentOf(std::span<const uint32_t> pixels, int width);
// Of all that has a normal.
ObjectExtent extentOf(const NormalMap& normals);

// What the object's outline has in the mean: the plane that the middle of a closed object stands on.
float outlineHeight(const NormalMap& normals, const Image& height);

// What sees the surface: a viewpoint of shaders/shared/lens.h. The surface's camera from the front, else as given.
glm::vec4 viewpointOf(const Surface& surface, const glm::vec3& view);

// Where each pixel's point lies, in widths of the object, which is all that has a normal: from the middle of its
// bounding box on the plane of its outline, x right, y up, z towards the camera. On that plane where the surface has no
// height. Where the surface has a camera, on the rays of its pixels. The surface's places where it has them.
std::vector<glm::vec3> pixelPlaces(const Surface& surface);

// The surface's height in the picture's scene (lens.h), of which horizons are: its height itself where it has no
// camera.
Image heightInPicture(const Surface& surface);

bool anyIsNear(std::span<const Light> lights);

// Whether lights or view differ between its pixels.
bool needsPlaces(const Surface& surface, std::span<const Light> lights, const glm::vec3& view);

// A light as a point at the place meets it, as a distant one; one that is not near stays as it is.
Light lightAt(const Light& light, const glm::vec3& place);

} // namespace nacre
