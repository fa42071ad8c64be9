#pragma once
#include <optional>
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

// One of a surface's materials.
struct SurfaceMaterial {
    Material material;
    RadianceScale scale = RadianceScale::relative;
};

// "NAME.nacre" (any folder): its first material; "NAME.nacre#skin": the one called so; "NAME.nacre#2": the second.
// Empty where the specification names no folder. Throws Error: data where the folder is no surface or is missing, usage
// that lists the materials where it has no such one.
std::optional<SurfaceMaterial> loadSurfaceMaterial(const std::string& specification);

// What to type for material `index` of the surface in `folder`.
std::string specificationOf(const std::string& folder, const Surface& surface, size_t index);

} // namespace nacre
