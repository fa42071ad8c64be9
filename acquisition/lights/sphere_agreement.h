#pragma once
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

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

} // namespace nacre
