#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

// Light between the points of a matt surface, which is smooth. A point x receives from the rest of it
//   H(x) = integral of K(x, y) J(y) dA(y),   K = cos cos' / (pi r^2) where x and y see each other, else 0,
// with J the light that y sends out. On a smooth surface K is bounded, since both cosines fall with r, so that a sum
// over points spread over it takes the integral's place (Nystrom 1930): no patch is too near another.

// Such a point, and the piece of the area that it stands for.
struct SurfaceNode {
    glm::dvec3 place{0};
    glm::dvec3 normal{0}; // unit
    double area = 0;
};

// What of a node's light arrives at a point, K dA: the form factor from the point to the node's piece.
struct FormFactor {
    uint32_t node = 0;
    float share = 0;
};
using FormFactors = std::vector<FormFactor>;

// Whether nothing stands between two points that face each other.
using Sees = std::function<bool(const glm::dvec3&, const glm::dvec3&)>;

FormFactors formFactorsAt(const glm::dvec3& place, const glm::dvec3& normal, const std::vector<SurfaceNode>& nodes,
                          const Sees& sees);
// `sent`: of every node.
glm::dvec3 arriving(const FormFactors& factors, const std::vector<glm::dvec3>& sent);

// What every node sends out after so many bounces, the one off itself included, of what the lights send to it:
//   J = albedo (E + K J), begun at 0.
// factors[i]: at node i.
std::vector<glm::dvec3> sentAfter(int bounces, const std::vector<FormFactors>& factors,
                                  const std::vector<glm::dvec3>& albedos, const std::vector<glm::dvec3>& lit);

} // namespace nacre
