#pragma once
#include "engine/files/image.h"
#include "engine/gpu/texture.h"

namespace nacre {

// A picture of codes in [0,1], 3 channels, to be copied into the window (kCopiedFrom), as the renderer's own are.
Texture uploadPicture(const Context& context, const Image& codes);

} // namespace nacre
