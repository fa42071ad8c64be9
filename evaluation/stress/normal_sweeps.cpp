#include "evaluation/stress/normal_sweeps.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "acquisition/lights/well_spread_lights.h"
#include "engine/files/error.h"
#include "engine/files/hash_random.h"
#include "evaluation/stress/capture_sweeps.h"
#include "evaluation/stress/light_layouts.h"

namespace nacre {

namespace {

constexpr double kCapDegrees = 55;

Degradation baseOf(const StressSubject& subject)
{
    Degradation base;
    base.noise = subject.noise;
    base.seed = subject.seed;
    return base;
}

using Settings = std::vector<Sweep::Setting>;

Sweep::Setting relitSetting(const StressSubject& subject, const std::string& value, const std::vector<Light>& lights)
{
    return {value, [&subject, lights] { return degraded(subject.relit(lights), baseOf(subject)); }};
}

Sweep::Setting selectedSetting(const StressSubject& subject, const std::string& value,
                               const std::vector<size_t>& chosen)
{
    return {value, [&subject, chosen] { return degraded(selectPhotographs(subject.clean, chosen), baseOf(subject)); }};
}

Settings specularSettings(const StressSubject& subject)
{
    Settings settings;
    for (const int percent : {0, 10, 25, 50, 75, 100}) {
        settings.push_back({std::to_string(percent),
                            [&subject, percent] { return degraded(subject.reglazed(0.01 * percent), baseOf(subject)); },
                            true});
    }
    return settings;
}

Settings countSettings(const StressSubject& subject)
{
    Settings settings;
    const size_t there = subject.clean.lights.size();
    for (const size_t count : {96, 48, 24, 12, 8, 6, 4, 3}) {
        const std::string value = std::to_string(count);
        if (subject.relit) {
            settings.push_back(relitSetting(subject, value, spreadLights(count, kCapDegrees)));
        } else if (count <= there) {
            settings.push_back(selectedSetting(subject, value, chosenLights(subject.clean.lights, {count, 0})));
        }
    }
    return settings;
}

// Photographs that are lost by chance, in the order of a seeded shuffle.
Settings missingSettings(const StressSubject& subject)
{
    Settings settings;
    std::vector<size_t> order(subject.clean.lights.size());
    for (size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::sort(order.begin(), order.end(),
              [&](size_t a, size_t b) { return hashOf(subject.seed, a) < hashOf(subject.seed, b); });
    for (const int percent : {0, 50, 75, 90}) {
        const size_t lost = order.size() * percent / 100;
        std::vector<size_t> kept(order.begin() + lost, order.end());
        std::sort(kept.begin(), kept.end());
        settings.push_back(selectedSetting(subject, std::to_string(percent), kept));
    }
    return settings;
}

Settings layoutSettings(const StressSubject& subject)
{
    const size_t n = subject.clean.lights.size();
    const float side = glm::radians(40.0f);
    return {relitSetting(subject, "spread", spreadLights(n, kCapDegrees)),
            relitSetting(subject, "ring", ringLights(n, 45)),
            relitSetting(subject, "cross", crossedLights(n)),
            relitSetting(subject, "narrow-ring", ringLights(n, 10)),
            relitSetting(subject, "one-side", spreadLights(n, 15, {std::sin(side), 0, std::cos(side)})),
            relitSetting(subject, "line", arcLights(n, 0))};
}

Settings coplanarSettings(const StressSubject& subject)
{
    Settings settings;
    for (const double degrees : {20.0, 10.0, 5.0, 2.0, 1.0, 0.5}) {
        settings.push_back(
            relitSetting(subject, fmt::format("{:g}", degrees), arcLights(subject.clean.lights.size(), degrees)));
    }
    return settings;
}

// A setting for each value, what it means told by `set`; or settings of its own.
struct NamedSweep {
    const char* name;
    const char* unit;
    std::vector<double> values;
    void (*set)(Degradation&, double value);
    Settings (*settings)(const StressSubject&) = nullptr;
    bool needsOtherLights = false;

    Sweep of(const StressSubject& subject) const
    {
        Sweep sweep{name, unit, settings ? settings(subject) : Settings{}};
        for (const double value : values) {
            Degradation degradation = baseOf(subject);
            set(degradation, value);
            sweep.settings.push_back(
                {fmt::format("{:g}", value), [&subject, degradation] { return degraded(subject.clean, degradation); }});
        }
        return sweep;
    }
};

const NamedSweep kSweeps[] = {
    {"noise", "% of the 99th percentile", {0.2, 1, 2, 5, 10}, [](Degradation& d, double v) { d.noise = v * 0.01; }},
    {"quantisation", "bits", {16, 8, 6, 5, 4}, [](Degradation& d, double v) { d.bits = static_cast<int>(v); }},
    {"saturation",
     "% of the values",
     {0, 2, 5, 15, 35},
     [](Degradation& d, double v) { d.overexposedShare = v * 0.01; }},
    {"shadow",
     "% of each pixel's lights",
     {0, 10, 20, 35, 50},
     [](Degradation& d, double v) { d.shadowShare = v * 0.01; }},
    {"direction", "degrees off", {0, 0.5, 1, 2, 5, 10}, [](Degradation& d, double v) { d.directionErrorDegrees = v; }},
    {"irradiance", "% off", {0, 2, 5, 10, 30}, [](Degradation& d, double v) { d.irradianceError = v * 0.01; }},
    {"lights", "well-spread lights", {}, nullptr, countSettings},
    {"missing", "% of the photographs at random", {}, nullptr, missingSettings},
    {"near",
     "object widths to the lights",
     {100, 20, 10, 5, 2.5, 1.2},
     [](Degradation& d, double v) { d.nearWidths = v; }},
    {"encoded",
     "gamma left in the photographs",
     {1, 1.1, 1.2, 1.5, 1.8, 2.2},
     [](Degradation& d, double v) { d.transferExponent = v; }},
    {"decoded",
     "gamma taken from linear photographs",
     {1, 1.1, 1.2, 1.5, 1.8, 2.2},
     [](Degradation& d, double v) { d.transferExponent = 1 / v; }},
    {"sphere",
     "% of its radius, its centre off",
     {0, 1, 2, 5, 10, 20},
     [](Degradation& d, double v) { d.sphereShift = v * 0.01; }},
    {"flipped", "y of the lights, and so green", {0, 1}, [](Degradation& d, double v) { d.flipped = v != 0; }},
    {"layout", "", {}, nullptr, layoutSettings, true},
    {"coplanar", "degrees beside one plane", {}, nullptr, coplanarSettings, true},
    {"specular", "% of the reflectance", {}, nullptr, specularSettings, true},
    {"distance-told",
     "object widths to lights whose places are told",
     {},
     nullptr,
     [](const StressSubject& s) { return distanceSettings(*s.made, true); },
     true},
    {"distance-sought",
     "object widths to lights whose directions alone are told",
     {},
     nullptr,
     [](const StressSubject& s) { return distanceSettings(*s.made, false); },
     true},
    {"lens-told",
     "degrees of a field of view that is told",
     {},
     nullptr,
     [](const StressSubject& s) { return viewSettings(*s.made, true); },
     true},
    {"lens-untold",
     "degrees of a field of view that is not told",
     {},
     nullptr,
     [](const StressSubject& s) { return viewSettings(*s.made, false); },
     true},
    {"interreflection",
     "% that a matt object reflects",
     {},
     nullptr,
     [](const StressSubject& s) { return interreflectionSettings(*s.made); },
     true},
};

} // namespace

StressSubject syntheticSubject(const SynthOptions& options)
{
    const auto scene = std::make_shared<const SynthScene>(makeSynthScene(options));
    StressSubject subject;
    subject.relit = [scene](const std::vector<Light>& lights) {
        SynthScene relit = *scene;
        relit.lights = lights;
        return photographedScene(relit);
    };
    subject.clean = subject.relit(spreadLights(static_cast<size_t>(options.lights), kCapDegrees));
    subject.reglazed = [options, lights = subject.clean.lights](double share) {
        SynthOptions glazed = options;
        glazed.material = fmt::format("ggx:diffuse={0},{1},{2};specular={3};alpha=0.2", 0.4 * (1 - share),
                                      0.3 * (1 - share), 0.2 * (1 - share), 0.5 * share);
        SynthScene reglazed = makeSynthScene(glazed);
        reglazed.lights = lights;
        return photographedScene(reglazed);
    };
    subject.noise = options.noise;
    subject.seed = options.seed;
    subject.made = options;
    subject.made->capDegrees = kCapDegrees;
    return subject;
}

StressSubject captureSubject(PhotographedObject object, uint64_t seed)
{
    return {std::move(object), 0, seed, {}, {}, {}};
}

std::vector<std::string> normalSweepNames()
{
    std::vector<std::string> names;
    for (const NamedSweep& sweep : kSweeps) {
        names.emplace_back(sweep.name);
    }
    return names;
}

std::vector<Sweep> normalSweeps(const StressSubject& subject, const std::vector<std::string>& names)
{
    std::vector<Sweep> sweeps;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(std::begin(kSweeps), std::end(kSweeps), [&](const NamedSweep& s) { return name == s.name; });
        if (found == std::end(kSweeps)) {
            throw Error("", fmt::format("sweep {} is not known", name),
                        fmt::format("one of {}", fmt::join(normalSweepNames(), ", ")), Error::kUsage);
        }
        if (found->needsOtherLights && !subject.relit) {
            throw Error("", fmt::format("sweep {} needs lights that the photographs do not have", name),
                        "`synthetic`, or another sweep", Error::kUsage);
        }
        sweeps.push_back(found->of(subject));
    }
    if (names.empty()) {
        for (const NamedSweep& sweep : kSweeps) {
            if (subject.relit || !sweep.needsOtherLights) {
                sweeps.push_back(sweep.of(subject));
            }
        }
    }
    return sweeps;
}

} // namespace nacre
