#pragma once
#include "engine/target/mesh.h"

namespace nacre {

// Gives normals to triangles with a vertex whose normal is 0: at each corner the sum over the triangles that share its
// place, each weighted by its area and by its angle there (Max, "Weights for Computing Vertex Normals from Facet
// Normals", 1999, has the angle; large triangles are the smoother shape). Triangles that meet at more than 60 degrees
// keep their edge. Vertices on an edge are split.
void smoothNormals(Mesh& mesh);

// For each vertex, the same number as for the first one at exactly the same place.
std::vector<uint32_t> firstVertexAtPlace(const std::vector<glm::vec3>& positions);

} // namespace nacre
