#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "assets/synth/synth_scene.h"
#include "evaluation/held_out/photographed_object.h"
#include "evaluation/stress/degradations.h"

namespace nacre {

// One condition at growing severity. The first setting is the mildest: breaking points are told against it.
struct Sweep {
    struct Setting {
        std::string value;
        std::function<PhotographedObject()> photographed;
        bool isOtherMaterial = false; // a BRDF from it is told against its own photographs, not the subject's
        // Where it is there, in place of `photographed`: a capture for the whole chain, in a folder that does not
        // exist yet. Its normals alone are judged.
        std::function<Capture(const std::filesystem::path&)> captured = {};
    };
    std::string name;
    std::string unit; // of the settings' values
    std::vector<Setting> settings;
};

// What a sweep starts from.
struct StressSubject {
    PhotographedObject clean;
    double noise = 0; // that every photograph of a sweep has beside its own condition, share of the 99th percentile
    uint64_t seed = 1;
    // The same object under other lights, noiseless; empty where only its photographs are there.
    std::function<PhotographedObject(const std::vector<Light>&)> relit;
    // The same under the same lights, of a gloss that has such a share of the reflectance; empty as above.
    std::function<PhotographedObject(double specularShare)> reglazed;
    // What it was made of, for captures of it; empty as above.
    std::optional<SynthOptions> made = std::nullopt;
};

// A solid that casts shadows on itself, under lights all over a cap of 55 degrees.
StressSubject syntheticSubject(const SynthOptions& options);
// Real photographs have their own noise.
StressSubject captureSubject(PhotographedObject object, uint64_t seed);

std::vector<std::string> normalSweepNames();

// The named sweeps (all where none is named) as far as the subject allows them. Throws Error (usage) on other names,
// and on sweeps that need other lights than those of photographs that were taken.
std::vector<Sweep> normalSweeps(const StressSubject& subject, const std::vector<std::string>& names);

} // namespace nacre
