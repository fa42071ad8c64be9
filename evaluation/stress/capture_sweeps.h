#pragma once
#include <filesystem>

#include "acquisition/capture/capture.h"
#include "assets/synth/synth_scene.h"
#include "evaluation/stress/normal_sweeps.h"

namespace nacre {

// A synthetic capture as files, and how much of it the program is told.
struct StressCapture {
    SynthOptions options;
    bool tellDistance = true; // where the lights stand, beside their directions
    bool tellView = true;     // of the camera
};

// Writes it into a folder that does not exist, and loads it: lights are as they are, there are no spheres.
Capture takenCapture(const StressCapture& stress, const std::filesystem::path& folder);

// Sweeps that need the whole chain, for what sees more than pixels one by one: places of lights, a lens, light from the
// rest of the object. `options`: of what they start from.
std::vector<Sweep::Setting> distanceSettings(const SynthOptions& options, bool told);
std::vector<Sweep::Setting> viewSettings(const SynthOptions& options, bool told);
std::vector<Sweep::Setting> interreflectionSettings(const SynthOptions& options);

} // namespace nacre
