#pragma once
#include "engine/gpu/direct_pass.h"
#include "engine/gpu/residual_pass.h"
#include "engine/scene/display.h"
#include "engine/scene/scene.h"

namespace nacre {

// Draws whole pictures by the direct path. Radiance, 16 bytes a pixel, is held for a band of rows at a time.
class DirectFrame {
public:
    static constexpr int kBandTexels = 1 << 20;

    DirectFrame(const Context& context, DirectPass& direct);

    // What is lit, and by what.
    struct Inputs {
        std::span<const TableTexture> tables;
        const LightGroups& lights;
        bool plain;             // isPlain of the surface
        ResidualPass* residual; // null: nothing is added
    };
    struct Look {
        Display display;
        bool hatched; // stripes where something unmeasured is asked for
    };

    // Drops what was made for another surface.
    void reset();
    // `codes` has kCodeFormat and the size of `pixels`; it is in kDrawnTo.
    void recordPicture(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, const Look& look,
                       const Texture& codes);
    // Linear radiance from 32-bit inputs. `pixels` is the same surface from one reset to the next.
    Frame radiance(const Surface& pixels, const Inputs& inputs);

    VkDeviceSize bytes() const;

private:
    // Of the band, which is made where it is missing.
    int rowsAtOnce(VkExtent3D picture);
    void recordRows(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, VkRect2D rows,
                    bool coverage);
    void readRows(const Surface& pixels, const Inputs& inputs, Frame& frame, int first, int count);

    const Context& context_;
    DirectPass& direct_;
    Sampler nearest_;
    Pipelines encoders_;
    Texture band_;
    Buffer readback_;     // of a band
    PixelTextures whole_; // 32-bit inputs, where one band holds the surface
};

} // namespace nacre
