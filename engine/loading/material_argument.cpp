#include "engine/loading/material_argument.h"

#include "engine/materials/material_specification.h"

namespace nacre {

Material materialFromArgument(const std::string& text, const std::filesystem::path& fits)
{
    return loadMaterial(text, fitsFolderFrom(fits));
}

} // namespace nacre
