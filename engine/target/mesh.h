#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "engine/scene/turn.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/zoom.h"

namespace nacre {

// Within a pixel the height of one surface changes by less pixels than this, up to 79 degrees.
inline constexpr float kSameSurface = 5;

// Triangles of one mesh and material of a file.
struct MeshPart {
    std::string name;
    size_t firstIndex = 0; // into Mesh::indices
    size_t indexCount = 0;
    bool hasUvs = false;
    std::shared_ptr<const NormalMap> normalMap{}; // tangent space, green up; null = none
    bool isSeen = true;                           // else it only hides what lies behind
};

// Vertices in the file's own axes (x right, y up, z towards the viewer where nothing else is asked for).
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  // unit, or 0 where there is none
    std::vector<glm::vec2> uvs;      // v up; empty, or one a vertex; of a relief, pixels of its picture
    std::vector<glm::vec4> tangents; // xyz unit or 0, w = handedness of the bitangent; empty, or one a vertex
    std::vector<uint32_t> indices;   // three a triangle
    std::vector<MeshPart> parts;     // in the order of their indices
    // Whose relief it is (relief.h), whose back is not known and not seen; null: no surface's.
    std::shared_ptr<const Surface> front{};

    size_t degenerateTriangles = 0; // without an area: left out
    size_t notFiniteTriangles = 0;  // with a vertex that is no number: left out
    bool normalsWereMade = false;   // in a part at least, the file has none

    size_t triangleCount() const { return indices.size() / 3; }
};

struct MeshViewOptions {
    glm::vec3 from{0, 0, 1}; // from the mesh towards the viewer, of any length
    glm::vec3 up{0, 1, 0};   // what is up in the picture; not along `from`
    int width = 1024;        // pixels
    int height = 1024;
    Turn turn{}; // of the mesh before that camera
};

// A distant camera that sees all of a mesh, fitted into the picture. A turned one stays where its middle was, as large
// as it was unless it would not fit.
struct MeshView {
    int width = 0;
    int height = 0;
    glm::dmat3 turn{1};       // from the mesh's axes to the camera's (x right, y up, z towards the viewer)
    glm::dvec3 centre{0};     // camera axes; shown in the picture's middle, height 0
    double pixelsPerUnit = 1; // of the mesh's length
    double nearest = 0;       // largest height, pixels
    double farthest = 0;      // smallest height

    // x right and y down in pixels from the picture's top left corner, z = height in pixels towards the viewer.
    glm::dvec3 pixelPoint(const glm::vec3& position) const
    {
        const glm::dvec3 p = pixelsPerUnit * (turn * glm::dvec3(position) - centre);
        return {0.5 * width + p.x, 0.5 * height - p.y, p.z};
    }
};

// Throws Error (usage) where up lies along from, Error (data) where the mesh has no extent in the view.
MeshView fittedView(const Mesh& mesh, const MeshViewOptions& options);

// The part of the view that a zoom shows, in the zoom's own pixels.
MeshView zoomedView(const MeshView& view, const Zoom& zoom);

} // namespace nacre
