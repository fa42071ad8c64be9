// What the shaders of a mesh's view and engine/target/mesh_raster.cpp agree on. Scalar layout.
#ifndef NACRE_MESH_LAYOUT_H
#define NACRE_MESH_LAYOUT_H
#include "glsl.h"
NACRE_SHARED_BEGIN

// Attributes of a vertex.
const int kMeshPoint = 0;   // xyz: right and down in samples from the top left corner, height in pixels
const int kMeshNormal = 1;  // camera frame
const int kMeshTangent = 2; // xyz camera frame, w handedness
const int kMeshUv = 3;

const int kBindingMeshNormalMap = 0; // sampled 2D, tangent space, green up
// Specialisation:
const int kConstantMeshMapped = 0; // the part has a normal map
const int kConstantMeshPacked = 1; // normals alone are drawn, packed

struct MeshConstants {
    vec2 samples;          // of the target, across and down
    float nearest;         // height, pixels
    float heightRange;     // nearest to farthest, pixels, above 0
    float samplesPerPixel; // along a side
    float label;           // of the part, plus 1; 0: what is drawn is not seen, and hides
    float columns;         // of the picture whose relief it is; 0: it is none's
};

// A camera that looks along -z sees no normal that faces away: what interpolation or a normal map turns beyond the rim
// is put on it, less a little (1 degree), so that it still counts as seen.
const float kMeshLeastZ = 0.0175f;

NACRE_FN vec3 normalInSight(vec3 n)
{
    return normalize(vec3(n.x, n.y, max(n.z, kMeshLeastZ)));
}

NACRE_SHARED_END
#endif
