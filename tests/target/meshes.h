#pragma once
#include <string>

#include "engine/target/mesh.h"

namespace nacre::test {

// A unit sphere of 2 x rings x rings triangles about, as OBJ text; normals with `withNormals`, faces wound the other
// way round with `reversed`.
std::string sphereObj(int rings, bool withNormals, bool reversed = false);

// A square from (-1,-1,0) to (1,1,0), its texture coordinates turned by quarter turns, and mirrored left to right first
// where asked, as OBJ text.
std::string squareObj(int quarterTurns, bool mirrored, bool withUvs = true);

} // namespace nacre::test
