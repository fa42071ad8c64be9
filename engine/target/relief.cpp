#include "engine/target/relief.h"

#include <algorithm>
#include <array>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace {

constexpr size_t kCoarseTriangles = 40'000; // some of lavapipe's milliseconds
constexpr int kSmoothingRounds = 8;         // over stairs of some four pixels

bool isStep(const Mesh& mesh, const std::array<uint32_t, 3>& corners, int stride)
{
    const auto [low, high] =
        std::minmax({mesh.positions[corners[0]].z, mesh.positions[corners[1]].z, mesh.positions[corners[2]].z});
    return high - low > kSameSurface * static_cast<float>(stride);
}

// Ends of the edges of one triangle alone, of triangles of a grid with so many columns.
std::vector<std::array<uint32_t, 2>> borderEdges(const std::vector<uint32_t>& indices, size_t vertices, int columns)
{
    constexpr size_t kKinds = 3; // of edges that begin at a vertex: to the right, down, and to the left below
    std::vector<uint8_t> triangles(kKinds * vertices);
    const auto forEachEdge = [&](const auto& visit) {
        for (size_t i = 0; i < indices.size(); ++i) {
            const auto [first, last] = std::minmax(indices[i], indices[i % 3 == 2 ? i - 2 : i + 1]);
            const auto along = static_cast<int>(last - first);
            visit(first, last, kKinds * first + (along == columns ? 1 : along == columns - 1 ? 2 : 0));
        }
    };
    forEachEdge([&](uint32_t, uint32_t, size_t edge) { ++triangles[edge]; });
    std::vector<std::array<uint32_t, 2>> border;
    forEachEdge([&](uint32_t first, uint32_t last, size_t edge) {
        if (triangles[edge] == 1) {
            border.push_back({first, last});
        }
    });
    return border;
}

// Moves the vertices of a border towards the middle of those beside them on it, which makes a line of pixels' stairs.
void smoothBorder(Mesh& mesh, int columns)
{
    const auto border = borderEdges(mesh.indices, mesh.positions.size(), columns);
    std::vector<glm::vec4> beside(mesh.positions.size());
    for (int round = 0; round < kSmoothingRounds; ++round) {
        for (const auto& [a, b] : border) {
            beside[a] += glm::vec4(mesh.positions[b], 1);
            beside[b] += glm::vec4(mesh.positions[a], 1);
        }
        for (const auto& edge : border) {
            for (const uint32_t i : edge) {
                if (beside[i].w > 0) {
                    mesh.positions[i] = 0.5f * (mesh.positions[i] + glm::vec3(beside[i]) / beside[i].w);
                    beside[i] = glm::vec4(0);
                }
            }
        }
    }
}

} // namespace

Mesh reliefMesh(std::shared_ptr<const Surface> front, int stride)
{
    const NormalMap& normals = front->normals;
    const int columns = (normals.width + stride - 1) / stride, rows = (normals.height + stride - 1) / stride;
    Mesh mesh;
    std::vector<uint8_t> isKnown;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const size_t i = normals.index(stride * x, stride * y);
            const glm::vec2 at(static_cast<float>(stride * x) + 0.5f, static_cast<float>(stride * y) + 0.5f);
            mesh.positions.emplace_back(at.x - 0.5f * static_cast<float>(normals.width),
                                        0.5f * static_cast<float>(normals.height) - at.y, front->height.values[i]);
            mesh.normals.push_back(normals.normals[i]);
            mesh.uvs.push_back(at);
            isKnown.push_back(normals.confidence[i] > 0);
        }
    }
    std::vector<uint32_t> steps;
    const auto add = [&](const std::array<uint32_t, 3>& corners) {
        if (std::all_of(corners.begin(), corners.end(), [&](uint32_t i) { return isKnown[i] != 0; })) {
            std::vector<uint32_t>& indices = isStep(mesh, corners, stride) ? steps : mesh.indices;
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
    };
    for (int y = 0; y + 1 < rows; ++y) {
        for (int x = 0; x + 1 < columns; ++x) {
            const auto a = static_cast<uint32_t>(y * columns + x), below = a + static_cast<uint32_t>(columns);
            add({a, below, a + 1});
            add({a + 1, below, below + 1});
        }
    }
    smoothBorder(mesh, columns);
    mesh.parts = {{.name = "known", .indexCount = mesh.indices.size()},
                  {.name = "steps", .firstIndex = mesh.indices.size(), .indexCount = steps.size(), .isSeen = false}};
    mesh.indices.insert(mesh.indices.end(), steps.begin(), steps.end());
    mesh.front = std::move(front);
    return mesh;
}

std::shared_ptr<const Mesh> coarseRelief(const std::shared_ptr<const Mesh>& relief)
{
    int stride = 1;
    while (relief->triangleCount() / static_cast<size_t>(stride * stride) > kCoarseTriangles) {
        ++stride;
    }
    return stride == 1 ? relief : std::make_shared<const Mesh>(reliefMesh(relief->front, stride));
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
