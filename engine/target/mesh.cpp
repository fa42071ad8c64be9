#include "engine/target/mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace {

constexpr double kMargin = 0.04; // of the picture's side, left free at either end

glm::dmat3 turnOf(const MeshViewOptions& options)
{
    constexpr double kLeastSine = 1e-3; // between from and up
    const glm::dvec3 from(options.from), up(options.up);
    const double lengths = glm::length(from) * glm::length(up);
    const glm::dvec3 right = glm::cross(up, from);
    if (!(glm::length(right) > kLeastSine * lengths)) {
        throw Error("",
                    fmt::format("up {:.3g},{:.3g},{:.3g} is no direction across from {:.3g},{:.3g},{:.3g}", up.x, up.y,
                                up.z, from.x, from.y, from.z),
                    "two directions that are not parallel, neither of them 0", Error::kUsage);
    }
    const glm::dvec3 z = glm::normalize(from), x = glm::normalize(right);
    return glm::transpose(glm::dmat3(x, glm::cross(z, x), z)); // rows are the camera's axes
}

} // namespace

MeshView fittedView(const Mesh& mesh, const MeshViewOptions& options)
{
    MeshView view{options.width, options.height, turnOf(options)};
    glm::dvec3 lowest(std::numeric_limits<double>::max()), highest(-lowest);
    for (const uint32_t index : mesh.indices) {
        const glm::dvec3 p = view.turn * glm::dvec3(mesh.positions[index]);
        lowest = glm::min(lowest, p);
        highest = glm::max(highest, p);
    }
    const glm::dvec3 extent = highest - lowest;
    const double least = 1e-9 * std::max({extent.x, extent.y, extent.z});
    if (mesh.indices.empty() || extent.x <= least || extent.y <= least) {
        throw Error("", "the mesh is seen edge-on: nothing of it shows", "another direction to look from");
    }
    view.centre = 0.5 * (lowest + highest);
    const double room = 1 - 2 * kMargin;
    view.pixelsPerUnit = room * std::min(options.width / extent.x, options.height / extent.y);
    view.nearest = 0.5 * view.pixelsPerUnit * extent.z;
    view.farthest = -view.nearest;
    return view;
}

} // namespace nacre
