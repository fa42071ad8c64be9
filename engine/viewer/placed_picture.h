#pragma once
#include <span>

#include "engine/files/image.h"
#include "engine/gpu/texture.h"
#include "engine/view_state/changed_tiles.h"
#include "engine/view_state/framing.h"

namespace nacre {

// A picture of codes in [0,1], 3 channels, to be copied into the window (kCopiedFrom), as the renderer's own are.
Texture uploadPicture(const Context& context, const Image& codes);

// Columns of a picture (kCopiedFrom), and where in the window they go: below all that ImGui draws.
struct PlacedPicture {
    const Texture* texture = nullptr;
    int firstColumn = 0;
    int endColumn = 0;
    Framing framing;      // a resolved one
    Area area;            // what lies outside is cut off
    bool isStill = false; // the texture is as it was when it was last placed
};

// All of the texture stretched over `place`, as far as it lies in `area`.
PlacedPicture placedPicture(const Texture& texture, const Area& place, const Area& area);

// Where in the window it may be.
PixelBox boxOf(const PlacedPicture& picture);

// Copies the pictures in order to what is in kDrawnTo, before and after.
void recordPictures(VkCommandBuffer commands, const Texture& target, std::span<const PlacedPicture> pictures);

} // namespace nacre
