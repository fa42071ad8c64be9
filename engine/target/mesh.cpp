#include "engine/target/mesh.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/files/error.h"
#include "engine/target/relief.h"

namespace nacre {
namespace {

constexpr double kMargin = 0.04; // of the picture's side, left free at either end
constexpr double kRoom = 1 - 2 * kMargin;

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

MeshView turnedView(const Mesh& mesh, MeshView view, const Turn& turn)
{
    const glm::dmat3 matrix = matrixOf(turn);
    view.turn = matrix * view.turn;
    view.centre = matrix * view.centre;
    glm::dvec3 reach(0);
    for (const uint32_t index : mesh.indices) {
        reach = glm::max(reach, glm::abs(view.turn * glm::dvec3(mesh.positions[index]) - view.centre));
    }
    const glm::dvec2 fitting = kRoom * 0.5 * glm::dvec2(view.width, view.height) / glm::max(glm::dvec2(reach), 1e-30);
    view.pixelsPerUnit = std::min({view.pixelsPerUnit, fitting.x, fitting.y});
    view.nearest = view.pixelsPerUnit * reach.z;
    view.farthest = -view.nearest;
    return view;
}

} // namespace

MeshView fittedView(const Mesh& mesh, const MeshViewOptions& options)
{
    if (mesh.front) {
        return reliefView(mesh, options);
    }
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
    view.pixelsPerUnit = kRoom * std::min(options.width / extent.x, options.height / extent.y);
    view.nearest = 0.5 * view.pixelsPerUnit * extent.z;
    view.farthest = -view.nearest;
    return options.turn == Turn() ? view : turnedView(mesh, view, options.turn);
}

MeshView zoomedView(const MeshView& view, const Zoom& zoom)
{
    const glm::dvec2 middle = glm::dvec2(zoom.origin) + 0.5 * glm::dvec2(zoom.size) / double{zoom.scale};
    MeshView zoomed = view;
    zoomed.width = zoom.size.x;
    zoomed.height = zoom.size.y;
    zoomed.centre.x += (middle.x - 0.5 * view.width) / view.pixelsPerUnit;
    zoomed.centre.y -= (middle.y - 0.5 * view.height) / view.pixelsPerUnit;
    for (double* length : {&zoomed.pixelsPerUnit, &zoomed.nearest, &zoomed.farthest}) {
        *length *= zoom.scale;
    }
    return zoomed;
}

} // namespace nacre
