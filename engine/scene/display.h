#pragma once
#include "engine/files/image.h"
#include "shared/tone.h"

namespace nacre {

// How linear radiance becomes a picture.
struct Display {
    float exposureStops = 0; // radiance times 2^this
    int toneCurve = kToneSrgb;
    bool operator==(const Display&) const = default;
};

// 8-bit code values in [0,1], rounded to n/255; 3 channels. The twin of shaders/display.frag.
Image displayedImage(const Image& radiance, const Display& display);

} // namespace nacre
