#include "acquisition/exemplar/normal_method.h"

#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "acquisition/exemplar/exemplar_estimator.h"
#include "acquisition/lights/lights.h"

namespace nacre {

namespace {

// Of the Lambertian methods the simpler wins a tie. Exemplars win one against them: they know what Lambert knows and
// highlights, too, and take doubtful pixels from consensus.
constexpr NormalMethod kLambertian[] = {NormalMethod::leastSquares, NormalMethod::consensus};
// A difference of the mean errors below so many standard errors, or so small a share, is a tie.
constexpr double kTieErrors = 2;
constexpr double kTieShare = 0.02;
// Fewer lights, none of which can be held out to judge, are Lambert's; from here on exemplars have two thirds of the
// error of consensus (docs/results.md).
constexpr size_t kFewestForExemplars = 6;
// Beyond it more than half of what is predicted is as wrong as counts: the errors no longer tell methods apart.
constexpr double kUnexplained = 0.5;

NormalEstimator makeLambertianEstimator(NormalMethod method, const std::vector<Light>& lights,
                                        const NormalOptions& options)
{
    switch (method) {
    case NormalMethod::leastSquares:
        return makeLeastSquaresEstimator(lights, options);
    case NormalMethod::threshold:
        return makeThresholdEstimator(lights, options);
    case NormalMethod::twoStep:
        return makeTwoStepEstimator(lights, options);
    case NormalMethod::ransac:
        return makeRansacEstimator(lights, options);
    case NormalMethod::exemplar:
    case NormalMethod::automatic:
    case NormalMethod::consensus:
        break;
    }
    return makeConsensusEstimator(lights, options);
}

// Whether errors, pixel by pixel, are smaller than those of the simpler method by more than chance.
bool isBetter(const std::vector<float>& errors, const std::vector<float>& simpler)
{
    double sum = 0, squares = 0;
    for (size_t p = 0; p < errors.size(); ++p) {
        const double gain = simpler[p] - errors[p];
        sum += gain;
        squares += gain * gain;
    }
    const double count = static_cast<double>(errors.size()), mean = sum / count,
                 standardError = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
    return mean > kTieErrors * standardError && mean > kTieShare * meanOf(simpler);
}

std::vector<float> lambertianErrors(NormalMethod method, const Jury& jury, const NormalOptions& options)
{
    const NormalEstimator estimator = makeLambertianEstimator(method, jury.split.keptLights, options);
    std::vector<glm::vec3> normals;
    for (const PixelNormal& pixel : estimator(jury.kept.intensities).pixels) {
        normals.push_back(pixel.albedo > 0 ? pixel.normal : glm::vec3(0, 0, 1));
    }
    return heldOutErrors(jury, normals, options.threads);
}

// The method whose normals let the object's own reflectance predict held-out lights best: each candidate estimates the
// sample's normals from the others.
NormalEstimator chosenEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, NormalReport& report)
{
    const std::optional<LightSplit> split = splitLights(lights);
    if (!split || sample.pixelCount() == 0) {
        const bool areEnough =
            sample.pixelCount() > 0 && lights.size() >= kFewestForExemplars && conditionOf(lights) <= kWorstSpan;
        report.method = areEnough ? NormalMethod::exemplar : NormalMethod::consensus;
        report.findings.push_back(
            {FindingCode::methodChosen,
             fmt::format("auto: {}, since {} lights are too few, or too nearly in one plane, to hold any out",
                         nameOf(report.method), lights.size())});
        return areEnough ? makeExemplarEstimator(sample, lights, options, report.findings)
                         : makeConsensusEstimator(lights, options);
    }
    const Jury jury = makeJury(sample, *split, options.threads);
    std::string said;
    std::vector<float> best;
    const auto consider = [&](NormalMethod method, std::vector<float> errors) {
        said += fmt::format("{}{} {:.4f}", said.empty() ? "" : ", ", nameOf(method), meanOf(errors));
        if (best.empty() || (method == NormalMethod::exemplar ? !isBetter(best, errors) : isBetter(errors, best))) {
            report.method = method;
            best = std::move(errors);
        }
    };
    for (const NormalMethod method : kLambertian) {
        consider(method, lambertianErrors(method, jury, options));
    }
    std::vector<Finding> ofExemplar;
    ExemplarModel model = makeExemplarModel(sample, lights, options, &jury, ofExemplar);
    consider(NormalMethod::exemplar, model.heldOutErrors);
    report.findings.push_back(
        {FindingCode::methodChosen, fmt::format("auto: {}, by the error on {} held-out lights: {}",
                                                nameOf(report.method), split->heldOut.size(), said)});
    report.heldOutError = meanOf(best);
    if (meanOf(best) > kUnexplained) {
        report.findings.push_back(
            {FindingCode::noMethod,
             "no method explains this object (a mirror? wrong lights?); the normals are not to be trusted"});
        report.method = NormalMethod::exemplar;
    }
    if (report.method != NormalMethod::exemplar) {
        return makeLambertianEstimator(report.method, lights, options);
    }
    append(report.findings, ofExemplar);
    return makeExemplarEstimator(std::move(model), lights, options);
}

} // namespace

NormalEstimator makeNormalEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                    const NormalOptions& options, NormalReport& report)
{
    report.method = options.method;
    switch (options.method) {
    case NormalMethod::automatic:
        return chosenEstimator(sample, lights, options, report);
    case NormalMethod::exemplar:
        return makeExemplarEstimator(sample, lights, options, report.findings);
    default:
        return makeLambertianEstimator(options.method, lights, options);
    }
}

} // namespace nacre
