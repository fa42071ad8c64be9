#pragma once
#include <filesystem>
#include <string>

#include "engine/scene/surface.h"

namespace nacre {

// What --material names (loadMaterial); `fits`: --fits, or empty. Throws Error.
Material materialFromArgument(const std::string& text, const std::filesystem::path& fits);

} // namespace nacre
