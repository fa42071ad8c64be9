#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/finding.h"
#include "acquisition/lights/diffuse_sphere.h"

namespace nacre {

// The turn that brings directions of lights, as a mirror sphere gives them, closest to those of the diffuse sphere's
// shading. A mirror sphere whose centre is off by a share s of its radius turns all of its lights by about 2 s radians.
struct CommonTurn {
    double degrees = 0;
    double standardError = 0; // degrees, by what is left of the disagreement
};
CommonTurn commonTurn(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading);

// A warning where the spheres disagree by a turn that is no chance; both per light.
std::optional<std::string> sphereWarning(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading);

struct CalibrationOptions {
    // Diffuse reflectance of the diffuse sphere per channel: makes the scale absolute.
    std::optional<glm::vec3> sphereReflectance;
    DiffuseSphereRules rules;
    int threads = 0;
};

// What each photograph's light is, and how it is known.
struct Rig {
    std::vector<Light> lights; // one per photograph, the capture's order
    std::vector<float>
        shadingDisagreement; // degrees per light between direction and the diffuse sphere's shading; empty without one
    float shadingOffset = 0; // constant that the diffuse sphere's photographs share, as radiance
    std::vector<Finding> warnings;
    std::string directionsFrom; // for the user
    std::string irradiancesFrom;
    bool absolute = false; // irradiance in units of which the BRDF comes out in 1/sr
    double condition = 0;  // of the matrix of directions: largest over smallest singular value
};

// Given lights as they are; else directions from the mirror sphere and irradiances from the diffuse one (scaled so
// that their mean is 1, unless the reflectance is given; 1 where there is no diffuse sphere). Throws Error where
// lights cannot be known, are fewer than three, or lie in one plane.
Rig calibrateLights(const Capture& capture, const CalibrationOptions& options = {});

// The lights' condition. Throws Error that names `source` where they are fewer than three or lie in one plane.
double requireSpanningLights(const std::vector<Light>& lights, const std::filesystem::path& source);

// Largest over smallest singular value of the n x 3 matrix of directions: by what a small error of the photographs is
// multiplied at worst in the normal. Infinite where the lights lie in one plane with the object.
double conditionOf(const std::vector<Light>& lights);

// Each reason why normals from such lights are not to be trusted, whatever their residuals say:
// lights so nearly in one plane or so close together that an error of 1 % in the photographs, which few are below, can
// turn normals by 4 degrees; too few to tell a shadow or a highlight from the surface's own shading.
std::vector<Finding> warningsOf(const std::vector<Light>& lights);

} // namespace nacre
