#pragma once
#include "engine/gpu/pass.h"
#include "engine/surface/zoom.h"

namespace nacre {

// Draws shaders/zoom.frag: a picture at another scale.
class ZoomFrame {
public:
    explicit ZoomFrame(const Context& context);

    // `cover` as MagnifiedSurface has it; empty where the zoom reduces.
    void set(const Zoom& zoom, std::span<const uint8_t> cover);
    // Of codes in kCopiedFrom: the whole picture, or the magnified part; black beside `drawn`.
    void draw(const Texture& picture, const VkRect2D& drawn);
    // In kCopiedFrom.
    const Texture& codes() const { return codes_; }

    VkDeviceSize bytes() const { return codes_.bytes() + cover_.bytes(); }

private:
    VkRect2D reached(const VkRect2D& drawn) const;

    const Context& context_;
    Pipelines pipelines_;
    Sampler nearest_;
    Zoom zoom_;
    Texture cover_; // one texel where it is not read
    Texture codes_;
};

} // namespace nacre
