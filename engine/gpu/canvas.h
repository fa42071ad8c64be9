#pragma once
#include <functional>
#include <memory>
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
    // In place of a surface's own, until pixels are dropped: compact ones that are on the device already.
    void usePixels(std::shared_ptr<const PixelTextures> pixels);
    const Texture& codes() const { return *codes_; } // once they were drawn
    // Codes of the pixels, into a target in kDrawnTo that is in kCopiedFrom afterwards.
    enum class Draws { everything, whatIsShown }; // and leaves pixels beside what is shown black
    void draw(Draws draws, const std::function<void(VkCommandBuffer, const Texture& codes)>& record);
    // Pixels that may be other than black.
    const VkRect2D& drawn() const { return drawn_; }

    VkDeviceSize bytes() const;

    BallFrame ballFrame;
    DirectFrame directFrame;
    bool isStale = true;

private:
    const Context& context_;
    std::shared_ptr<const PixelTextures> pixels_; // compact
    std::optional<Texture> codes_;                // kCodeFormat
    VkRect2D drawn_{};
};

// Codes (kCodeFormat, in kCopiedFrom) in [0,1], n/255; 3 channels.
Image readCodes(const Context& context, const Texture& codes);

} // namespace nacre
