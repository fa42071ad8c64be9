#pragma once
#include <functional>

#include "engine/gpu/buffer.h"
#include "engine/gpu/texture.h"

namespace nacre {

// What shaders draw to that draw four pixels at a time: kPixelsPerTexel codes side by side in a texel, held for a band
// of the picture's rows and copied to it.
class FoursTarget {
public:
    static constexpr uint32_t kBandPixels = 1 << 18; // 1 MiB; larger bands are no quicker

    explicit FoursTarget(const Context& context) : context_(context) {}

    // Drops what was made for a picture of another size.
    void reset();
    // Of kIntegersFormat. `drawRows` is called with the first row of each band, while the band is being rendered to.
    // `codes` has kCodeFormat; it is in kDrawnTo. Of its pixels only those of `part`, and some beside them, are drawn.
    void record(VkCommandBuffer commands, const Texture& codes, const VkRect2D& part,
                const std::function<void(int)>& drawRows);

    VkDeviceSize bytes() const { return band_.bytes() + copied_.bytes(); }

private:
    void makeBand(VkExtent3D picture);
    void copyRows(VkCommandBuffer commands, const Texture& codes, const VkRect2D& texels, int first);

    const Context& context_;
    Texture band_;
    Buffer copied_; // its texels, on the way to the picture
};

} // namespace nacre
