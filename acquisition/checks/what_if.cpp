#include "acquisition/checks/what_if.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "acquisition/checks/matte_scatter.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr double kExponents[] = {1 / 2.2, 0.56, 0.67, 0.83, 0.91, 1.1, 1.2, 1.5, 1.8, 2.2};
constexpr double kWidths[] = {20, 10, 5, 2.5};
// Of the scatter that is left. Gloss, noise and lights that err leave curves more than 0.7 and distances more than
// 0.95; published photographs (docs/limitations.md) as much.
constexpr double kTellingCurve = 0.65;
constexpr double kTellingDistance = 0.93;
// Photographs that follow Lambert's law as well as this have nothing to be undone.
constexpr double kLeastScatter = 0.004;
// Directions from a pixel to near lights change what it sees by its own normal, which has to be known: in steps.
constexpr int kDistanceSteps = 2;
constexpr float kLeastTurnedCosine = 0.1f;

Observations powerOf(const Observations& seen, double exponent)
{
    Observations result = seen;
    for (glm::vec3& radiance : result.radiance) {
        radiance = glm::pow(glm::max(radiance, glm::vec3(0)), glm::vec3(static_cast<float>(exponent)));
    }
    return result;
}

// Places in widths of the object, from its middle: x right, y up.
std::vector<glm::vec3> placesOf(const Observations& seen)
{
    std::vector<glm::vec3> places;
    glm::vec3 least(1e9f), most(-1e9f);
    for (const uint32_t pixel : seen.pixels) {
        places.emplace_back(static_cast<float>(pixel % static_cast<uint32_t>(seen.width)),
                            -static_cast<float>(pixel / static_cast<uint32_t>(seen.width)), 0.0f);
        least = glm::min(least, places.back());
        most = glm::max(most, places.back());
    }
    const float across = std::max({most.x - least.x, most.y - least.y, 1.0f});
    for (glm::vec3& place : places) {
        place = (place - 0.5f * (least + most)) / across;
    }
    return places;
}

// What distant lights would show: the square of the distance and the pixel's own direction are taken out.
Intensities asIfDistant(const Intensities& intensities, const std::vector<glm::vec3>& places,
                        const std::vector<Light>& lights, const NormalBlock& fit, float distance)
{
    Intensities result = intensities;
    for (size_t p = 0; p < places.size(); ++p) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const glm::vec3 towards = lights[i].direction - places[p] / distance, &normal = fit.pixels[p].normal;
            const float length = glm::length(towards), far = glm::dot(normal, lights[i].direction),
                        near = glm::dot(normal, towards) / length;
            if (far > kLeastTurnedCosine && near > kLeastTurnedCosine) {
                result.values[p * result.stride + i] *= far / near * length * length;
            }
        }
    }
    return result;
}

// The scatter that is left where a photograph's values are raised to a power, or a light's distance is taken out.
double scatterOfPower(const Observations& seen, const std::vector<Light>& lights, const NormalEstimator& consensus,
                      const MatteChoice& matte, double exponent)
{
    const Intensities bent = intensitiesOf(powerOf(seen, exponent), lights);
    return matteScatter(bent, consensus(bent), lights, matte) / exponent;
}

double scatterAtDistance(const Intensities& intensities, const std::vector<glm::vec3>& places,
                         const std::vector<Light>& lights, const NormalEstimator& consensus, const MatteChoice& matte,
                         NormalBlock near, double distance)
{
    Intensities distant;
    for (int step = 0; step < kDistanceSteps; ++step) {
        distant = asIfDistant(intensities, places, lights, near, static_cast<float>(distance));
        near = consensus(distant);
    }
    return matteScatter(distant, near, lights, matte);
}

} // namespace

std::optional<CaptureDefect> findDefect(const Observations& seen, const std::vector<Light>& lights,
                                        const NormalOptions& options, double scatter)
{
    if (scatter < kLeastScatter) {
        return {};
    }
    NormalOptions alone = options;
    alone.threads = 1; // the trials run beside each other
    const NormalEstimator consensus = makeConsensusEstimator(lights, alone);
    const Intensities intensities = intensitiesOf(seen, lights);
    const NormalBlock fit = consensus(intensities);
    const MatteChoice matte = matteObservations(intensities, fit, lights);
    const std::vector<glm::vec3> places = seen.width > 0 ? placesOf(seen) : std::vector<glm::vec3>();
    std::vector<CaptureDefect> trials;
    for (const double exponent : kExponents) {
        trials.push_back({exponent > 1 ? CaptureDefect::Kind::encoded : CaptureDefect::Kind::decoded, exponent, 0});
    }
    for (const double distance : kWidths) {
        if (!places.empty()) {
            trials.push_back({CaptureDefect::Kind::nearLights, distance, 0});
        }
    }
    parallelFor(trials.size(), 1, options.threads, [&](size_t first, size_t last) {
        for (size_t t = first; t < last; ++t) {
            CaptureDefect& trial = trials[t];
            trial.scatter = trial.kind == CaptureDefect::Kind::nearLights
                                ? scatterAtDistance(intensities, places, lights, consensus, matte, fit, trial.size)
                                : scatterOfPower(seen, lights, consensus, matte, trial.size);
        }
    });
    std::optional<CaptureDefect> best;
    for (const CaptureDefect& trial : trials) {
        const double telling = trial.kind == CaptureDefect::Kind::nearLights ? kTellingDistance : kTellingCurve;
        if (trial.scatter < telling * scatter && (!best || trial.scatter < best->scatter)) {
            best = trial;
        }
    }
    return best;
}

} // namespace nacre
