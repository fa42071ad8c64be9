#pragma once
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/observations.h"
#include "acquisition/lights/lights.h"
#include "assets/synth/synth_scene.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// An object whose normals are known: its photographs in memory, and what a program is told of their lights.
struct PhotographedObject {
    std::string name;
    Observations seen;                    // all of the object, one block; its pixels are of the grid below
    int width = 0, height = 0;            // of that grid: photographs, or every n-th of their rows and columns
    std::vector<std::string> photographs; // names, one per light
    std::vector<Light> lights;
    bool irradiancesKnown = true;
    std::vector<glm::vec3>
        shadingDirections; // of the lights, as a diffuse sphere's shading gives them, where there is one
    NormalMap truth;       // one row, pixel by pixel as in `seen`
};

// Radiance as the light leaves the object: no noise, no limit, no steps.
PhotographedObject photographedScene(const SynthScene& scene);

// Some thousand pixels of a real capture: every n-th of its rows and columns. Throws Error where its normals or lights
// are not known.
PhotographedObject photographedCapture(const Capture& capture, const CalibrationOptions& calibration);

// As if the other photographs had not been taken.
PhotographedObject selectPhotographs(const PhotographedObject& object, const std::vector<size_t>& chosen);

// The q-quantile of all that was seen, every channel for itself: full scale of a camera that clips the rest.
float valueQuantile(const Observations& seen, double q);

} // namespace nacre
