#pragma once
#include <vector>

#include "engine/gpu/texture.h"
#include "engine/scene/surface.h"

namespace nacre {

// full: 32-bit floats, for radiance that is measured. compact: 16 bits a channel, for pictures: half the memory and
// time.
enum class Precision { full, compact };

// A surface's pixels on the device.
struct PixelTextures {
    // full: xyz, w = confidence, all 0 without data. compact: packed. Where the surface is plain, pixels without its
    // material count as without data.
    Texture normals;
    Texture albedo;   // rgb, w = material index; empty where the surface is plain
    Texture horizon;  // an array of azimuths; empty where nothing casts shadows
    Texture residual; // an array of kComponentsPerTexel a texel; empty where there is no layer
    VkDeviceSize bytes() const { return normals.bytes() + albedo.bytes() + horizon.bytes() + residual.bytes(); }
};

// One material whose albedo factor is 1, and no residual layer: the normals say it all.
bool isPlain(const Surface& surface);

// The pixels of `surface`; `plain` says what isPlain does of the whole of which they are.
PixelTextures uploadPixels(const Context& context, const Surface& surface, bool plain, Precision precision);

struct TableTexture {
    Texture texture; // f in 1/sr, w = confidence
    TableDomain domain;
    bool knowsCoverage = false;
};

TableTexture uploadTable(const Context& context, const BrdfTable& table);

} // namespace nacre
