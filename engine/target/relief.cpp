#include "engine/target/relief.h"

#include <algorithm>
#include <array>
#include <limits>

#include <glm/common.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace {

bool isStep(const Image& height, const std::array<uint32_t, 3>& corners)
{
    const auto [low, high] =
        std::minmax({height.values[corners[0]], height.values[corners[1]], height.values[corners[2]]});
    return high - low > kSameSurface;
}

} // namespace

Mesh reliefMesh(std::shared_ptr<const Surface> front)
{
    const NormalMap& normals = front->normals;
    const Image& height = front->height;
    Mesh mesh;
    const int width = normals.width, rows = normals.height;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < width; ++x) {
            const size_t i = normals.index(x, y);
            const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            mesh.positions.emplace_back(at.x - 0.5f * static_cast<float>(width), 0.5f * static_cast<float>(rows) - at.y,
                                        height.values[i]);
            mesh.normals.push_back(normals.normals[i]);
            mesh.uvs.push_back(at);
        }
    }
    std::vector<uint32_t> steps;
    const auto add = [&](const std::array<uint32_t, 3>& corners) {
        if (std::all_of(corners.begin(), corners.end(), [&](uint32_t i) { return normals.confidence[i] > 0; })) {
            std::vector<uint32_t>& indices = isStep(height, corners) ? steps : mesh.indices;
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
    };
    for (int y = 0; y + 1 < rows; ++y) {
        for (int x = 0; x + 1 < width; ++x) {
            const auto a = static_cast<uint32_t>(normals.index(x, y)), below = a + static_cast<uint32_t>(width);
            add({a, below, a + 1});
            add({a + 1, below, below + 1});
        }
    }
    mesh.parts = {{.name = "known", .indexCount = mesh.indices.size()},
                  {.name = "steps", .firstIndex = mesh.indices.size(), .indexCount = steps.size(), .isSeen = false}};
    mesh.indices.insert(mesh.indices.end(), steps.begin(), steps.end());
    mesh.front = std::move(front);
    return mesh;
}

MeshView reliefView(const Mesh& relief, const MeshViewOptions& options)
{
    if (relief.indices.empty()) {
        throw Error("", "nothing of the height is known", "a surface with an object in it");
    }
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    for (const uint32_t i : relief.indices) {
        low = glm::min(low, glm::dvec3(relief.positions[i]));
        high = glm::max(high, glm::dvec3(relief.positions[i]));
    }
    const glm::dvec3 middle = 0.5 * (low + high);
    MeshView view{options.width, options.height, matrixOf(options.turn)};
    glm::dvec3 reach(0);
    for (const uint32_t i : relief.indices) {
        reach = glm::max(reach, glm::abs(view.turn * (glm::dvec3(relief.positions[i]) - middle)));
    }
    view.centre = view.turn * middle - glm::dvec3(middle.x, middle.y, 0);
    const NormalMap& picture = relief.front->normals;
    const double room = std::min(0.5 * options.width / (std::abs(middle.x) + reach.x),
                                 0.5 * options.height / (std::abs(middle.y) + reach.y));
    view.pixelsPerUnit = std::min({static_cast<double>(options.width) / picture.width,
                                   static_cast<double>(options.height) / picture.height, room});
    view.nearest = view.pixelsPerUnit * reach.z;
    view.farthest = -view.nearest;
    return view;
}

} // namespace nacre
