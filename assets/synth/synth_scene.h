#pragma once
#include <vector>

#include "assets/synth/bumpy_solid.h"
#include "assets/synth/orthographic_view.h"
#include "assets/synth/sensor.h"
#include "assets/synth/synth_options.h"
#include "engine/brdf/brdf_models.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

// What a synthetic capture photographs: the truth behind every file of it.
struct SynthScene {
    static constexpr uint8_t kNoMaterial = 255;

    SynthOptions options;
    BumpySolid solid;
    OrthographicView view;
    std::vector<Light> lights;
    std::vector<BrdfModel> models;
    std::vector<uint8_t> labels; // per pixel of the photograph: index into models; kNoMaterial beside the object
    // Gain and noise serve the whole capture, spheres included; each photograph's values are gain * radiance.
    Sensor sensor;
};

// Throws Error (usage) where an option makes no capture.
SynthScene makeSynthScene(const SynthOptions& options);

// 1 where the light reaches the pixel's surface point: neither attached nor cast shadow (the latter where asked for).
std::vector<uint8_t> litPixels(const SynthScene& scene, const Light& light, int threads);

// Radiance f E n.l of the object's pixels, 3 channels; 0 in shadow and beside the object.
Image objectRadiance(const SynthScene& scene, const Light& light, int threads);

} // namespace nacre
