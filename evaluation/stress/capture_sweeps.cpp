#include "evaluation/stress/capture_sweeps.h"

#include <fmt/format.h>

#include "assets/synth/synth_capture.h"

namespace nacre {

namespace {

constexpr int kManyBounces = 8;

Sweep::Setting capturedSetting(const std::string& value, const StressCapture& stress)
{
    return {value, {}, false, [stress](const std::filesystem::path& folder) { return takenCapture(stress, folder); }};
}

} // namespace

Capture takenCapture(const StressCapture& stress, const std::filesystem::path& folder)
{
    SynthOptions options = stress.options;
    options.format = SynthFormat::exr;
    options.giveLights = true;
    writeSynthCapture(folder, makeSynthScene(options), false);
    Capture capture = loadCapture(folder);
    capture.mirrorSphere.reset();
    capture.diffuseSphere.reset();
    if (!stress.tellDistance) {
        capture.lightPlaces.clear();
    }
    if (!stress.tellView) {
        capture.fieldOfView.reset();
    }
    return capture;
}

std::vector<Sweep::Setting> distanceSettings(const SynthOptions& options, bool told)
{
    std::vector<Sweep::Setting> settings;
    for (const double widths : {100.0, 20.0, 10.0, 5.0, 2.5, 1.2}) {
        StressCapture stress{.options = options, .tellDistance = told};
        stress.options.lightDistance = widths;
        settings.push_back(capturedSetting(fmt::format("{:g}", widths), stress));
    }
    return settings;
}

std::vector<Sweep::Setting> viewSettings(const SynthOptions& options, bool told)
{
    std::vector<Sweep::Setting> settings;
    for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0}) {
        StressCapture stress{.options = options, .tellView = told};
        stress.options.fieldOfView = degrees;
        settings.push_back(capturedSetting(fmt::format("{:g}", degrees), stress));
    }
    return settings;
}

std::vector<Sweep::Setting> interreflectionSettings(const SynthOptions& options)
{
    std::vector<Sweep::Setting> settings;
    for (const int percent : {10, 30, 50, 70, 90}) {
        StressCapture stress{.options = options};
        stress.options.material = fmt::format("lambert:{}", 0.01 * percent);
        stress.options.bounces = kManyBounces;
        settings.push_back(capturedSetting(std::to_string(percent), stress));
    }
    return settings;
}

} // namespace nacre
