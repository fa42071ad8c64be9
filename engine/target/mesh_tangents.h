#pragma once
#include "engine/target/mesh.h"

namespace nacre {

// Tangents along u at each vertex, as MikkTSpace means them (Mikkelsen, "Simulation of Wrinkled Surfaces Revisited",
// 2008): the mean over the vertex's triangles, weighted by angle, in the plane of its normal; vertices where mirrored
// triangles meet are split. Its welding of vertices that are alike but not the same is done here by place, normal and
// UV.
void makeTangents(Mesh& mesh);

} // namespace nacre
