#pragma once
#include <filesystem>

#include <glm/vec3.hpp>

#include "acquisition/lights/sphere_outline.h"
#include "engine/files/image.h"

namespace nacre {

// A highlight found on a mirror sphere.
struct Highlight {
    double x = 0; // image coordinates, see Circle
    double y = 0;
    size_t pixels = 0;
};

// The centroid of the bright region, which is what Eq. 1's brightest pixel becomes where many tie at the top: of the
// connected regions above half of the way from the sphere's median to its peak, the one with the most light.
// Throws Error where there is no highlight, or where the outline or the frame cuts it.
Highlight findHighlight(const Image& photograph, const Circle& outline, const std::filesystem::path& source);

// Direction of the light, unit, from the sphere towards it: the view (0,0,1) mirrored at the highlight's normal
// (Wu et al., Image-based BRDF Acquisition for Non-spherical Objects, Eq. 1).
glm::vec3 lightFromHighlight(const Highlight& highlight, const Circle& outline);

} // namespace nacre
