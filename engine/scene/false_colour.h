#pragma once
#include <span>

#include "engine/files/image.h"
#include "engine/scene/scene.h"
#include "shared/false_colour.h"

namespace nacre {

// What a picture shows of a scene. coverage is the picture with stripes where it is uncertain (coverage.h). thetaH and
// thetaD are those of the brightest light, as the object's middle meets it, where it reaches.
enum class Show {
    picture = kShowPicture,
    normals = kShowNormals,
    labels = kShowLabels,
    coverage = kShowCoverage,
    thetaH = kShowThetaH,
    thetaD = kShowThetaD,
    verdicts // on a photograph's observations: of a window that has the photographs, not of the renderer
};

// What shaders/false_colour.frag is given. The brightest light is the one of the largest sum of irradiance, the first
// among equals.
FalseColourConstants falseColourConstants(std::span<const Light> lights, const glm::vec3& view, size_t materials);

// The CPU twin of the renderer's pictures that show something else than the picture. Code values in [0,1], n/255; black
// where there is no normal or no material, and where the surface faces away.
Image referenceFalseColour(const Scene& scene, Show show, const Display& display, int threads = 0);

} // namespace nacre
