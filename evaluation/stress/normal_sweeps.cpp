#include "evaluation/stress/normal_sweeps.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "acquisition/lights/well_spread_lights.h"
#include "engine/files/error.h"
#include "engine/files/hash_random.h"
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

// The values of one member of Degradation.
template <class Member>
Sweep degradationSweep(const StressSubject& subject, const char* name, const char* unit, Member Degradation::*member,
                       const std::vector<double>& values, double factor)
{
    Sweep sweep{name, unit, {}};
    for (const double value : values) {
        Degradation degradation = baseOf(subject);
        degradation.*member = static_cast<Member>(value * factor);
        sweep.settings.push_back(
            {fmt::format("{:g}", value), [&subject, degradation] { return degraded(subject.clean, degradation); }});
    }
    return sweep;
}

Sweep::Setting relitSetting(const StressSubject& subject, const std::string& value, const std::vector<Light>& lights)
{
    return {value, [&subject, lights] { return degraded(subject.relit(lights), baseOf(subject)); }};
}

Sweep::Setting selectedSetting(const StressSubject& subject, const std::string& value,
                               const std::vector<size_t>& chosen)
{
    return {value, [&subject, chosen] { return degraded(selectPhotographs(subject.clean, chosen), baseOf(subject)); }};
}

Sweep noiseSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "noise", "% of the 99th percentile", &Degradation::noise, {0.2, 1, 2, 5, 10},
                            0.01);
}

Sweep quantisationSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "quantisation", "bits", &Degradation::bits, {16, 8, 6, 5, 4}, 1);
}

Sweep saturationSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "saturation", "% of the values", &Degradation::overexposedShare, {0, 2, 5, 15, 35},
                            0.01);
}

Sweep shadowSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "shadow", "% of each pixel's lights", &Degradation::shadowShare,
                            {0, 10, 20, 35, 50}, 0.01);
}

Sweep directionSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "direction", "degrees off", &Degradation::directionErrorDegrees,
                            {0, 0.5, 1, 2, 5, 10}, 1);
}

Sweep irradianceSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "irradiance", "% off", &Degradation::irradianceError, {0, 2, 5, 10, 30}, 0.01);
}

// A setting per value, what it means told by `set`.
template <class Set>
Sweep setSweep(const StressSubject& subject, const char* name, const char* unit, const std::vector<double>& values,
               const Set& set)
{
    Sweep sweep{name, unit, {}};
    for (const double value : values) {
        Degradation degradation = baseOf(subject);
        set(degradation, value);
        sweep.settings.push_back(
            {fmt::format("{:g}", value), [&subject, degradation] { return degraded(subject.clean, degradation); }});
    }
    return sweep;
}

Sweep nearSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "near", "object widths to the lights", &Degradation::nearWidths,
                            {100, 20, 10, 5, 2.5, 1.2}, 1);
}

Sweep encodedSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "encoded", "gamma left in the photographs", &Degradation::transferExponent,
                            {1, 1.1, 1.2, 1.5, 1.8, 2.2}, 1);
}

Sweep decodedSweep(const StressSubject& subject)
{
    return setSweep(subject, "decoded", "gamma taken from linear photographs", {1, 1.1, 1.2, 1.5, 1.8, 2.2},
                    [](Degradation& degradation, double gamma) { degradation.transferExponent = 1 / gamma; });
}

Sweep sphereSweep(const StressSubject& subject)
{
    return degradationSweep(subject, "sphere", "% of its radius, its centre off", &Degradation::sphereShift,
                            {0, 1, 2, 5, 10, 20}, 0.01);
}

Sweep flippedSweep(const StressSubject& subject)
{
    return setSweep(subject, "flipped", "y of the lights, and so green", {0, 1},
                    [](Degradation& degradation, double flipped) { degradation.flipped = flipped != 0; });
}

Sweep specularSweep(const StressSubject& subject)
{
    Sweep sweep{"specular", "% of the reflectance", {}};
    for (const int percent : {0, 10, 25, 50, 75, 100}) {
        sweep.settings.push_back(
            {std::to_string(percent),
             [&subject, percent] { return degraded(subject.reglazed(0.01 * percent), baseOf(subject)); }, true});
    }
    return sweep;
}

Sweep countSweep(const StressSubject& subject)
{
    Sweep sweep{"lights", "well-spread lights", {}};
    const size_t there = subject.clean.lights.size();
    for (const size_t count : {96, 48, 24, 12, 8, 6, 4, 3}) {
        const std::string value = std::to_string(count);
        if (subject.relit) {
            sweep.settings.push_back(relitSetting(subject, value, spreadLights(count, kCapDegrees)));
        } else if (count <= there) {
            sweep.settings.push_back(selectedSetting(subject, value, chosenLights(subject.clean.lights, {count, 0})));
        }
    }
    return sweep;
}

// Photographs that are lost by chance, in the order of a seeded shuffle.
Sweep missingSweep(const StressSubject& subject)
{
    Sweep sweep{"missing", "% of the photographs at random", {}};
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
        sweep.settings.push_back(selectedSetting(subject, std::to_string(percent), kept));
    }
    return sweep;
}

Sweep layoutSweep(const StressSubject& subject)
{
    const size_t n = subject.clean.lights.size();
    const float side = glm::radians(40.0f);
    return {"layout",
            "",
            {relitSetting(subject, "spread", spreadLights(n, kCapDegrees)),
             relitSetting(subject, "ring", ringLights(n, 45)), relitSetting(subject, "cross", crossedLights(n)),
             relitSetting(subject, "narrow-ring", ringLights(n, 10)),
             relitSetting(subject, "one-side", spreadLights(n, 15, {std::sin(side), 0, std::cos(side)})),
             relitSetting(subject, "line", arcLights(n, 0))}};
}

Sweep coplanarSweep(const StressSubject& subject)
{
    Sweep sweep{"coplanar", "degrees beside one plane", {}};
    for (const double degrees : {20.0, 10.0, 5.0, 2.0, 1.0, 0.5}) {
        sweep.settings.push_back(
            relitSetting(subject, fmt::format("{:g}", degrees), arcLights(subject.clean.lights.size(), degrees)));
    }
    return sweep;
}

struct NamedSweep {
    const char* name;
    Sweep (*make)(const StressSubject&);
    bool needsOtherLights;
};

constexpr NamedSweep kSweeps[] = {{"noise", noiseSweep, false},
                                  {"quantisation", quantisationSweep, false},
                                  {"saturation", saturationSweep, false},
                                  {"shadow", shadowSweep, false},
                                  {"direction", directionSweep, false},
                                  {"irradiance", irradianceSweep, false},
                                  {"lights", countSweep, false},
                                  {"missing", missingSweep, false},
                                  {"near", nearSweep, false},
                                  {"encoded", encodedSweep, false},
                                  {"decoded", decodedSweep, false},
                                  {"sphere", sphereSweep, false},
                                  {"flipped", flippedSweep, false},
                                  {"layout", layoutSweep, true},
                                  {"coplanar", coplanarSweep, true},
                                  {"specular", specularSweep, true}};

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
    return subject;
}

StressSubject captureSubject(PhotographedObject object, uint64_t seed)
{
    return {std::move(object), 0, seed, {}, {}};
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
        sweeps.push_back(found->make(subject));
    }
    if (names.empty()) {
        for (const NamedSweep& sweep : kSweeps) {
            if (subject.relit || !sweep.needsOtherLights) {
                sweeps.push_back(sweep.make(subject));
            }
        }
    }
    return sweeps;
}

} // namespace nacre
