#include "acquisition/checks/what_if.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "acquisition/checks/matte_scatter.h"

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

} // namespace

std::optional<CaptureDefect> findDefect(const Observations& seen, const std::vector<Light>& lights,
                                        const NormalOptions& options, double scatter)
{
    if (scatter < kLeastScatter) {
        return {};
    }
    const NormalEstimator consensus = makeConsensusEstimator(lights, options);
    const Intensities intensities = intensitiesOf(seen, lights);
    const NormalBlock fit = consensus(intensities);
    const MatteChoice matte = matteObservations(intensities, fit, lights);
    std::optional<CaptureDefect> best;
    const auto consider = [&](CaptureDefect::Kind kind, double size, double left, double telling) {
        if (left < telling * scatter && (!best || left < best->scatter)) {
            best = {kind, size, left};
        }
    };
    for (const double exponent : kExponents) {
        const Intensities bent = intensitiesOf(powerOf(seen, exponent), lights);
        consider(exponent > 1 ? CaptureDefect::Kind::encoded : CaptureDefect::Kind::decoded, exponent,
                 matteScatter(bent, consensus(bent), lights, matte) / exponent, kTellingCurve);
    }
    if (seen.width <= 0) {
        return best;
    }
    const std::vector<glm::vec3> places = placesOf(seen);
    for (const double distance : kWidths) {
        NormalBlock near = fit;
        Intensities distant;
        for (int step = 0; step < kDistanceSteps; ++step) {
            distant = asIfDistant(intensities, places, lights, near, static_cast<float>(distance));
            near = consensus(distant);
        }
        consider(CaptureDefect::Kind::nearLights, distance, matteScatter(distant, near, lights, matte),
                 kTellingDistance);
    }
    return best;
}

} // namespace nacre
