#pragma once
#include "engine/target/mesh.h"

namespace nacre {

// The height of `front` between its pixels, or one of `stride` along each side (px, in px; x right, y up about the
// picture's middle), with its normals: what is known of the object, seen from its front alone. Where neighbours differ
// by a step, what joins them is not known, and is a part that hides what lies behind it without being seen. Borders of
// what is known are lines in place of its pixels' stairs.
Mesh reliefMesh(std::shared_ptr<const Surface> front, int stride = 1);

// The same of fewer of its pixels, as is quick to draw while it is turned.
std::shared_ptr<const Mesh> coarseRelief(const std::shared_ptr<const Mesh>& relief);

// As it stands in its own picture, fitted into the size; turned about the middle of what is known, as large as it was
// unless it would not fit.
MeshView reliefView(const Mesh& relief, const MeshViewOptions& options);

} // namespace nacre
