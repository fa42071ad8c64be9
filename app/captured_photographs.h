#pragma once
#include <filesystem>

#include "engine/viewer/photographs.h"

namespace nacre {

// The photographs of a capture as a window shows them beside the surface that was measured from them. Nothing is read
// before it is asked for. Verdicts are those of the surface's own model.
Photographs photographsOf(const std::filesystem::path& capture, const std::filesystem::path& surface);

} // namespace nacre
