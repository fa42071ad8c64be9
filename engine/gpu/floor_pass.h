#pragma once
#include "engine/gpu/fours_target.h"
#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"

namespace nacre {

// What any picture of a surface costs at least: its inputs read, a colour written, no lighting (shaders/floor.frag),
// into the target that pictures from balls are drawn to.
class FloorPass {
public:
    // The inputs are those of a picture: 16 bits a channel, albedo factors and labels where the surface is not plain.
    FloorPass(const Context& context, const Surface& surface);

    void draw();

private:
    const Context& context_;
    bool plain_;
    PixelTextures pixels_;
    Texture codes_;
    FoursTarget target_;
    Sampler nearest_;
    Pipeline pipeline_;
};

} // namespace nacre
