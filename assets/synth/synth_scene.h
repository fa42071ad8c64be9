#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "assets/synth/bouncing_light.h"
#include "assets/synth/bumpy_solid.h"
#include "engine/brdf/brdf_models.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"

namespace nacre {

enum class SynthShape { sphere, bumpy, bowl };
enum class SynthFormat { png16, exr };

// A capture whose truth is known.
struct SynthOptions {
    SynthShape shape = SynthShape::bumpy;
    int width = 256; // pixels
    int height = 256;
    int sphereSize = 320; // side of the calibration spheres' photographs; their highlights must be some pixels wide
    std::string material = "ggx:diffuse=0.5,0.3,0.2;specular=0.04;alpha=0.2"; // material_specification.h
    std::vector<std::string> patches; // further materials: the object wears them and the first in patches
    std::filesystem::path fitsFolder; // of the published fits
    int lights = 36;
    double capDegrees = 50;                  // largest angle between a light and the view
    double lightDistance = 0;                // of all lights, in widths of the object; 0: they are distant
    double fieldOfView = 0;                  // degrees that the picture's width covers; 0: the camera is distant
    double leastIrradiance = 0.7;            // of a light's channel, drawn evenly from [least, largest]
    double largestIrradiance = 1.3;          //
    bool shadows = true;                     // cast ones; attached ones are part of the reflectance equation
    int bounces = 0;                         // of light between the object's own points; matt (BouncingLight)
    double noise = 0.002;                    // standard deviation, of the 99th percentile of the object's values
    SynthFormat format = SynthFormat::png16; // exr: float32, the object's values are not clipped
    std::vector<double> exposures{1.0};      // relative times of every photograph's bracket; the longest comes first
    bool giveLights = false;                 // write the true lights into capture.json
    bool shadowMasks = false;                // truth/shadow_NN.png, 1 = lit
    glm::vec3 sphereReflectance{0.5f};       // albedo of the diffuse sphere
    uint64_t seed = 1;                       // of the lights' places and strengths, and of the noise
    int threads = 0;                         // 0 = all
};

// The capture that `nacre demo` makes for itself: a glazed, coloured ceramic under 36 lights.
SynthOptions demoCapture();

// A Fibonacci spiral over the cap about the view, each light moved a little and with an irradiance of its own.
std::vector<Light> synthLights(const SynthOptions& options);

// Turns radiance into a photograph's linear values, 1 = full scale.
struct Sensor {
    double gain = 1;   // value per unit of radiance at exposure time 1
    double noise = 0;  // standard deviation of a value, whatever the exposure time
    bool clips = true; // integer pictures stop at full scale
    uint64_t seed = 1;
};

// The photograph taken with a relative exposure time; `photograph` tells noises apart.
Image exposed(const Image& radiance, const Sensor& sensor, double seconds, uint64_t photograph);

// What a synthetic capture photographs: the truth behind every file of it.
struct SynthScene {
    static constexpr uint8_t kNoMaterial = 255;

    SynthOptions options;
    BumpySolid solid;
    SolidView view;
    std::vector<Light> lights; // as the middle of the object's outline meets them
    glm::dvec3 middle{0};      // of the outline, in the view's unit
    double lightDistance = 0;  // from there in that unit; 0: distant
    std::vector<BrdfModel> models;
    std::vector<uint8_t> labels; // per pixel of the photograph: index into models; kNoMaterial beside the object
    std::shared_ptr<const BouncingLight> bouncing; // empty: no light bounces
    // Gain and noise serve the whole capture, spheres included; each photograph's values are gain * radiance.
    Sensor sensor;
};

// Throws Error (usage) where an option makes no capture.
SynthScene makeSynthScene(const SynthOptions& options);

// The light as a point meets it.
Light lightAt(const SynthScene& scene, const glm::dvec3& place, const Light& light);

// 1 where the light reaches the pixel's surface point: neither attached nor cast shadow (the latter where asked for).
std::vector<uint8_t> litPixels(const SynthScene& scene, const Light& light, int threads);

// Radiance of the object's pixels, 3 channels, 0 beside the object: f E n.l where the light reaches, and what bounces.
Image objectRadiance(const SynthScene& scene, const Light& light, int threads);

} // namespace nacre
