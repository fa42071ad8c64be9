#include "acquisition/checks/what_if.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "acquisition/near_field/as_if_distant.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr double kExponents[] = {1 / 2.2, 0.56, 0.67, 0.83, 0.91, 1.1, 1.2, 1.5, 1.8, 2.2};
constexpr double kWidths[] = {20, 10, 5, 2.5};
// Of the scatter that is left. Gloss, noise and lights that err leave curves more than 0.7 and distances more than
// 0.95; published photographs (docs/limitations.md) as much.
constexpr double kTellingCurve = 0.65;
// What is left where the curve was the cause: that of photographs that are known to be good.
constexpr double kLambertian = 0.015;
constexpr double kTellingDistance = 0.93;
// Photographs that follow Lambert's law as well as this have nothing to be undone.
constexpr double kLeastScatter = 0.004;
// Directions from a pixel to near lights change what it sees by its own normal, which has to be known: in steps.
constexpr int kTrialSteps = 3;

Observations powerOf(const Observations& seen, double exponent)
{
    Observations result = seen;
    for (glm::vec3& radiance : result.radiance) {
        radiance = glm::pow(glm::max(radiance, glm::vec3(0)), glm::vec3(static_cast<float>(exponent)));
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

} // namespace

bool isLambertian(double scatter)
{
    return scatter < kLambertian;
}

bool tellsCurve(double scatter, double scatterAsTaken)
{
    return scatterAsTaken > kLeastScatter && scatter < kTellingCurve * scatterAsTaken && isLambertian(scatter);
}

double scatterAtDistance(const Observations& seen, const std::vector<Light>& lights, const NearField& near,
                         const Image& height, const NormalEstimator& consensus, const MatteChoice& matte)
{
    const LocalLights local(lights, near, height, seen.width);
    std::vector<glm::vec3> normals;
    double scatter = 0;
    for (int step = 0; step < kTrialSteps; ++step) {
        const Intensities distant = intensitiesOf(asIfDistant(seen, local, normals, 1), lights);
        const NormalBlock fit = consensus(distant);
        normals.clear();
        for (const PixelNormal& pixel : fit.pixels) {
            normals.push_back(pixel.normal);
        }
        scatter = matteScatter(distant, fit, lights, matte);
    }
    return scatter;
}

DefectSearch findDefect(const Observations& seen, const std::vector<Light>& lights, const NormalOptions& options,
                        double scatter)
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
    const ObjectExtent extent = seen.width > 0 ? extentOf(seen.pixels, seen.width) : ObjectExtent();
    NearField camera;
    camera.origin = camera.axis = extent.middle;
    std::vector<CaptureDefect> trials;
    for (const double exponent : kExponents) {
        trials.push_back({exponent > 1 ? CaptureDefect::Kind::encoded : CaptureDefect::Kind::decoded, exponent, 0});
    }
    for (const double distance : kWidths) {
        if (seen.width > 0) {
            trials.push_back({CaptureDefect::Kind::nearLights, distance, 0});
        }
    }
    parallelFor(trials.size(), 1, options.threads, [&](size_t first, size_t last) {
        for (size_t t = first; t < last; ++t) {
            CaptureDefect& trial = trials[t];
            trial.scatter =
                trial.kind == CaptureDefect::Kind::nearLights
                    ? scatterAtDistance(seen, lights, withLightsAt(camera, lights, trial.size * extent.width), {},
                                        consensus, matte)
                    : scatterOfPower(seen, lights, consensus, matte, trial.size);
        }
    });
    DefectSearch found{{},
                       {{FindingCode::transferCurveLeft, 0, 1 - kTellingCurve},
                        {FindingCode::transferCurveTaken, 0, 1 - kTellingCurve},
                        {FindingCode::lightsNear, 0, 1 - kTellingDistance}}};
    for (const CaptureDefect& trial : trials) {
        CheckFigure& figure = found.figures[static_cast<size_t>(trial.kind)];
        figure.value = std::max(figure.value, 1 - trial.scatter / scatter);
        if (1 - trial.scatter / scatter > figure.limit && (!found.defect || trial.scatter < found.defect->scatter)) {
            found.defect = trial;
        }
    }
    return found;
}

} // namespace nacre
