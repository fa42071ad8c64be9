#pragma once
#include "engine/target/mesh.h"

namespace nacre {

// Half the size: means of the up to four normals that have data, not made unit again, so that a rough part becomes
// flatter, as it is seen from afar.
NormalMap halvedNormalMap(const NormalMap& map);

// The part's normal map, halved as often as keeps a sample from skipping texels, where one unit of the mesh's length is
// `samplesPerUnit` samples.
NormalMap seenNormalMap(const Mesh& mesh, const MeshPart& part, double samplesPerUnit);

} // namespace nacre
