#pragma once
#include <filesystem>
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

// What --material names (loadMaterial); `fits`: --fits, or empty. Throws Error.
Material materialFromArgument(const std::string& text, const std::filesystem::path& fits);

} // namespace nacre
