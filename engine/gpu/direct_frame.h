#pragma once
#include <span>
#include <vector>

#include "engine/files/image.h"
#include "engine/gpu/moving_lights.h"
#include "engine/gpu/pass.h"
#include "engine/gpu/residual_pass.h"
#include "engine/gpu/surface_textures.h"
#include "engine/lights/light.h"
#include "engine/scene/scene.h"

namespace nacre {

// Lights as shaders read them, on the device, in groups of kLightsPerGroup.
class LightGroups {
public:
    // `viewpoint`: shaders/shared/lens.h.
    void upload(const Context& context, std::span<const Light> lights, const glm::vec4& viewpoint);

    size_t lightCount() const { return lights_.size(); }
    std::span<const Light> lights() const { return lights_; }
    const glm::vec4& viewpoint() const { return viewpoint_; }
    ShaderInput group(size_t index) const;
    VkDeviceSize bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_;
    std::vector<Light> lights_;
    glm::vec4 viewpoint_{0, 0, 1, 0};
};

// Draws shaders/direct.frag: one material's radiance under a range of lights, added to the target, which has
// kFloatFormat and is being rendered to.
class DirectPass {
public:
    explicit DirectPass(const Context& context);

    struct Inputs {
        const Texture& normals;
        const Texture* albedo; // null: all pixels have the material, and albedo 1
        const TableTexture& table;
        int material;
        int firstRow = 0;                 // of the surface, in the target's row 0
        bool coverage = false;            // alpha tells how far off radiance may be, where the table knows
        const Texture* horizon = nullptr; // of the height that casts shadows; null: none does
        const Texture* places = nullptr;  // of the pixels before near lights; null: all lights are drawn as distant
    };
    // Lights [first, last) in order; first is a multiple of kLightsPerGroup.
    void record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first, size_t last);

private:
    const Context& context_;
    Pipelines pipelines_;
    Sampler nearest_;
    Sampler linear_;
    Texture noHorizon_; // bound where there are no shadows, but not read
};

// Draws whole pictures by the direct path. Radiance, 16 bytes a pixel, is held for a band of rows at a time.
class DirectFrame {
public:
    static constexpr int kBandTexels = 1 << 20;

    DirectFrame(const Context& context, DirectPass& direct);

    // What is lit, and by what.
    struct Inputs {
        std::span<const TableTexture> tables;
        const LightGroups& lights;
        LightRange still;       // whose radiance is kept from one picture to the next; empty: none is
        LightRange moved;       // the others
        bool plain;             // isPlain of the surface
        ResidualPass* residual; // null: nothing is added
    };
    struct Look {
        Display display;
        bool hatched; // stripes where the picture is uncertain
    };

    // Drops what was made for another surface.
    void reset();
    // `codes` has kCodeFormat and the size of `pixels`; it is in kDrawnTo. Of its pixels only those of pixels.shown are
    // drawn.
    void recordPicture(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, const Look& look,
                       const Texture& codes);
    // Linear radiance from 32-bit inputs. `pixels` is the same surface from one reset to the next.
    Frame radiance(const Surface& pixels, const Inputs& inputs);

    VkDeviceSize bytes() const;

private:
    // What the kept radiance depends on beside the pixels.
    struct Kept {
        std::vector<Light> lights;
        glm::vec4 viewpoint{0};
        bool coverage = false;
        bool operator==(const Kept&) const = default;
    };

    // Of the band, which is made where it is missing.
    int rowsAtOnce(VkExtent3D picture);
    void recordLights(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                      const LightRange& lights, int firstRow, bool coverage);
    // Radiance of the lights that stay, in still_.
    void recordStill(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, bool coverage);
    // All of the radiance, in the band; of the lights that stay as still_ has it where that is asked for.
    void recordRows(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs, VkRect2D rows,
                    bool coverage, bool fromStill);
    void readRows(const Surface& pixels, const Inputs& inputs, Frame& frame, int first, int count);

    const Context& context_;
    DirectPass& direct_;
    Sampler nearest_;
    Pipelines encoders_;
    Pipeline add_;
    Texture still_; // in kSampled; empty where nothing is kept
    Kept kept_;     // in it
    Texture band_;
    Buffer readback_;     // of a band
    PixelTextures whole_; // 32-bit inputs, where one band holds the surface
};

} // namespace nacre
