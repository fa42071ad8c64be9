#pragma once
#include <functional>
#include <optional>

#include "engine/gpu/ball_frame.h"
#include "engine/gpu/direct_frame.h"
#include "engine/gpu/surface_textures.h"

namespace nacre {

// Pixels of a surface on the device, and the codes that are drawn of them.
class Canvas {
public:
    Canvas(const Context& context, DirectPass& direct)
        : ballFrame(context), directFrame(context, direct), context_(context)
    {
    }

    // Drops what was made of the pixels, for others of one size or of another.
    void dropPixels();
    void dropPicture();
    const PixelTextures& pixels(const Surface& surface, bool plain);
    const Texture& codes() const { return *codes_; } // once they were drawn
    // Codes from black, into a target in kDrawnTo that is in kCopiedFrom afterwards.
    void draw(const Surface& surface, const std::function<void(VkCommandBuffer, const Texture& codes)>& record);

    VkDeviceSize bytes() const;

    BallFrame ballFrame;
    DirectFrame directFrame;
    bool isStale = true;

private:
    const Context& context_;
    std::optional<PixelTextures> pixels_; // compact
    std::optional<Texture> codes_;        // kCodeFormat
};

// Codes (kCodeFormat, in kCopiedFrom) in [0,1], n/255; 3 channels.
Image readCodes(const Context& context, const Texture& codes);

} // namespace nacre
