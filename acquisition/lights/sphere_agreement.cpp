#include "acquisition/lights/sphere_agreement.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace nacre {

namespace {

constexpr size_t kFewestLights = 3;
constexpr double kLargestSphereTurn = 2; // degrees; real spheres: docs/limitations.md
constexpr double kSigmas = 3;

} // namespace

CommonTurn commonTurn(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading)
{
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double squares = 0;
    for (size_t i = 0; i < mirror.size(); ++i) {
        const Eigen::Vector3d l(mirror[i].x, mirror[i].y, mirror[i].z), s(shading[i].x, shading[i].y, shading[i].z);
        Eigen::Matrix3d cross; // w x l as a matrix times w
        cross << 0, l.z(), -l.y(), -l.z(), 0, l.x(), l.y(), -l.x(), 0;
        products += cross.transpose() * cross;
        right += cross.transpose() * (s - l);
        squares += (s - l).squaredNorm();
    }
    const Eigen::Vector3d turn = products.completeOrthogonalDecomposition().solve(right);
    const double left = std::max(0.0, squares - turn.dot(right));
    const double freedom = std::max(1.0, 2.0 * static_cast<double>(mirror.size()) - 3);
    // About x and y alone: lights around the view say little of a turn about it, and it harms least.
    const double error = std::sqrt(
        left / freedom * products.completeOrthogonalDecomposition().pseudoInverse().topLeftCorner<2, 2>().trace());
    return {glm::degrees(turn.head<2>().norm()), glm::degrees(error)};
}

std::optional<std::string> sphereWarning(const std::vector<glm::vec3>& mirror, const std::vector<glm::vec3>& shading)
{
    if (mirror.size() < kFewestLights || mirror.size() != shading.size()) {
        return {};
    }
    const CommonTurn turn = commonTurn(mirror, shading);
    if (turn.degrees < kLargestSphereTurn || turn.degrees < kSigmas * turn.standardError) {
        return {};
    }
    return fmt::format("the diffuse sphere's shading puts all lights {:.1f} degrees to one side of where they are said "
                       "to be; check the outlines (masks) of the spheres",
                       turn.degrees);
}

} // namespace nacre
