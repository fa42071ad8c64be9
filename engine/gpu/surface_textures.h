#pragma once
#include <vector>

#include "engine/gpu/buffer.h"
#include "engine/gpu/texture.h"
#include "engine/surface/surface.h"

namespace nacre {

// full: 32-bit floats, for radiance that is measured. compact: 16 bits a channel, for pictures: half the memory and
// time.
enum class Precision { full, compact };

// A surface's pixels on the device.
struct PixelTextures {
    // full: xyz, w = confidence, all 0 without data. compact: packed. Where the surface is plain, pixels without its
    // material count as without data.
    Texture normals;
    Texture albedo;        // rgb, w = material index; empty where the surface is plain
    Texture horizon;       // an array of azimuths; empty where nothing casts shadows
    Texture places;        // xyz, of the surface's places; empty where it has none
    TexelBuffer residual;  // of kIntegersFormat, a pixel's components side by side; empty where there is no layer
    int residualFours = 0; // components, in fours
    VkRect2D shown{};      // holds all pixels that have data
    VkDeviceSize bytes() const
    {
        return normals.bytes() + albedo.bytes() + horizon.bytes() + places.bytes() + residual.bytes();
    }
};

// The albedo's texture, or one that shaders which do not read it may be given in its place.
inline const Texture& albedoOrAny(const PixelTextures& pixels)
{
    return pixels.albedo.bytes() > 0 ? pixels.albedo : pixels.normals;
}

// One material whose albedo factor is 1: but for a residual layer the normals say it all.
bool isPlain(const Surface& surface);

// The pixels of `surface`; `plain` says what isPlain does of the whole of which they are.
PixelTextures uploadPixels(const Context& context, const Surface& surface, bool plain, Precision precision);

struct TableTexture {
    Texture texture; // f in 1/sr, w = its expected relative error
    TableDomain domain;
    bool knowsCoverage = false;
};

TableTexture uploadTable(const Context& context, const BrdfTable& table);

} // namespace nacre
