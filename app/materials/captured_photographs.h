#pragma once
#include <filesystem>
#include <memory>

#include "engine/viewer/photographs.h"

namespace nacre {

// The photographs of a capture as a window shows them beside the surface that was measured from them; read when they
// are asked for, but a capture that does not go with the surface is refused at once. Verdicts are those of the
// surface's own model. Throws Error.
std::unique_ptr<Photographs> photographsOf(const std::filesystem::path& capture, const std::filesystem::path& surface);

} // namespace nacre
