#pragma once
#include "engine/surface/height_from_normals.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/surface.h"

namespace nacre {

// Whether normals are those of a height: then the slope across grows upwards as the slope upwards grows across,
// dp/dy = dq/dx. A green that points the wrong way turns that into dp/dy = -dq/dx.
enum class GreenVerdict {
    agrees,
    flipped,
    undecided // flat, cylindrical or too noisy: both ways explain the map alike
};

struct Integrability {
    GreenVerdict verdict = GreenVerdict::undecided;
    // Mean |dp/dy - dq/dx| as the map is over the same with green flipped, at the scale where they differ most.
    double residualRatio = 1;
};

Integrability checkIntegrability(const NormalMap& map);

// A surface whose height was integrated from its normals.
struct IntegratedSurface {
    Surface surface;
    size_t pieces = 0; // whose heights against each other are not known
};

// Of one part, wherever there is a normal; a tangent-space map is a flat piece seen from the front.
IntegratedSurface surfaceOfNormals(const NormalMap& normals);

// Normals and labels of an acquired surface, its materials as names of parts; its height, or one integrated from the
// normals where it has none.
IntegratedSurface surfaceWithoutMaterials(Surface acquired);

// What to tell the user of a map that does not fit a height as `normalY` reads it but would with green flipped; empty
// where nothing is to be said.
std::string flippedGreenWarning(const std::filesystem::path& file, const NormalMap& map, NormalY normalY);

} // namespace nacre
