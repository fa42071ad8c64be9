#include "engine/loading/cast_shadows.h"

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/target/height_from_normals.h"

namespace nacre {

void castShadows(Surface& surface, const std::filesystem::path& source)
{
    if (surface.height.values.empty()) {
        if (!std::filesystem::is_directory(source)) {
            throw Error(source, "has no height that could cast shadows",
                        "a NAME.nacre, which nacre target makes of normals, or no --shadows", Error::kUsage);
        }
        IntegratedHeight integrated = heightFromNormals(surface.normals);
        surface.height = std::move(integrated.height);
        fmt::print(stderr, "nacre: note: {} has no height: shadows are cast by one integrated from its normals{}\n",
                   source.string(),
                   integrated.pieces > 1
                       ? fmt::format(", in {} pieces whose heights against each other are not known", integrated.pieces)
                       : "");
    }
    surface.horizon = horizonMap(surface.normals, surface.height);
}

} // namespace nacre
