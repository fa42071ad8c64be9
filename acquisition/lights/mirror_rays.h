#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/lights/light.h"

namespace nacre {

// From a mirror sphere's highlight to the light that makes it: a point of the sphere and a unit direction. Camera
// frame, in widths of the object from its middle; spheres stand on the plane of its outline.
struct MirrorRay {
    glm::dvec3 from{0};
    glm::dvec3 direction{0, 0, 1};
};

// Of irradiance 1, as the object's middle meets them; distant ones where nothing places them.
struct MirrorLights {
    std::vector<Light> lights;
    double apart =
        0; // degrees from where the lights stand, or from their directions, to a sphere's ray; root mean square
    std::string placed; // how they are placed, for the user; empty: they are distant
};

// `rays`: one a sphere, for each light. `distance`: of all lights from the middle, in widths; infinite: they are
// distant. Where it is not known and spheres are several, lights stand where their rays come closest to each other, if
// rays turn towards each other by more than chance and by more than those of harmless distances (near_field.h).
MirrorLights lightsOfRays(const std::vector<std::vector<MirrorRay>>& rays, std::optional<double> distance);

} // namespace nacre
