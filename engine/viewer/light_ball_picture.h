#pragma once
#include "engine/viewer/view_pictures.h"

namespace nacre {

// The ball of lights: the surface's most frequent material under the lights of its picture.
class LightBallPicture {
public:
    explicit LightBallPicture(const Context& context) : direct_(context) {}

    // Another surface, with materials.
    void setSurface(const Surface& surface);
    // `size` in pixels. From the balls of the picture, where it has some; else directly, under distant lights, since
    // markers lie where the ball is brightest.
    const Texture& draw(ViewPictures& pictures, int size);

private:
    Renderer direct_;
    size_t material_ = 0;
    int directSize_ = 0; // pixels; 0: another material's
};

// The material on a ball, lit from the upper left, exposed by itself; codes. `size` in pixels.
Image materialThumbnail(const Context& context, const Material& material, int size);

} // namespace nacre
