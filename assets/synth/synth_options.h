#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

enum class SynthShape { sphere, bumpy };
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
    double leastIrradiance = 0.7;            // of a light's channel, drawn evenly from [least, largest]
    double largestIrradiance = 1.3;          //
    bool shadows = true;                     // cast ones; attached ones are part of the reflectance equation
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

} // namespace nacre
