#include "evaluation/held_out/held_out.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "acquisition/chain/reconciled_photographs.h"
#include "acquisition/normals/light_triples.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/files/stopwatch.h"
#include "evaluation/held_out/irradiance_scale.h"

namespace nacre {

namespace {

struct Truth {
    Observations heldOut, given;
    std::vector<Light> heldOutLights, givenLights;
    double peak = 1, greyPeak = 1;
};

double greyPeakOf(const Observations& all)
{
    std::vector<float> values;
    values.reserve(all.radiance.size());
    for (const glm::vec3& v : all.radiance) {
        values.push_back(greyOf(v));
    }
    return peakOf(values);
}

bool areIrradiancesGiven(const Capture& capture)
{
    return capture.irradianceGiven || capture.diffuseSphere.has_value();
}

// The irradiances that all photographs together give, where the acquisition may correct them: one that nobody can know
// from the others says nothing of a method.
Rig reconciledRig(const Capture& capture, Rig rig, const Observations& all, const AcquireOptions& options)
{
    CaptureSample sample{evenSample(all), {}, areIrradiancesGiven(capture), rig.lights};
    for (const Photograph& photograph : capture.photographs) {
        sample.photographs.push_back(photograph.name);
    }
    const ReconciledPhotographs reconciled = reconcilePhotographs(std::move(sample), options);
    for (size_t i = 0; i < reconciled.agreeing.size(); ++i) {
        rig.lights[reconciled.agreeing[i]] = reconciled.sample.lights[i];
    }
    return rig;
}

// With the irradiances that the acquisition found; of photographs that it left out, as they were.
std::vector<Light> lightsAsFound(const Surface& surface, const Capture& capture, const std::vector<size_t>& given,
                                 std::vector<Light> lights)
{
    for (size_t i = 0; i < given.size(); ++i) {
        for (const CapturedLight& found : surface.lights) {
            if (found.photograph == capture.photographs[given[i]].name) {
                lights[i].irradiance = found.light.irradiance;
            }
        }
    }
    return lights;
}

// What stands for the given photographs is the same for every method: what the acquisition made of those alone.
Truth readTruth(const Capture& capture, const Rig& calibrated, const std::vector<size_t>& heldOut,
                const std::vector<size_t>& given, const Surface& surface, const AcquireOptions& options)
{
    ObservationReader reader(capture, options.normals.threads, ~size_t{0});
    Observations all;
    reader.next(all);
    const Rig rig = reconciledRig(capture, calibrated, all, options);
    const std::vector<Light> reconciled = selectLights(rig, given).lights,
                             found = lightsAsFound(surface, capture, given, reconciled);
    std::vector<Light> asked = selectLights(rig, heldOut).lights;
    (areIrradiancesGiven(capture) ? bringToMedianScale : bringToScale)(reconciled, found, asked);
    return {selectLights(all, heldOut), selectLights(all, given), asked, found, peakOf(all.radiance), greyPeakOf(all)};
}

double ownPeakOf(const Observations& seen, size_t photograph)
{
    std::vector<float> values;
    for (size_t p = 0; p < seen.pixels.size(); ++p) {
        values.push_back(greyOf(seen.radianceOf(p)[photograph]));
    }
    return peakOf(values);
}

// Squared errors of one method over all that was held out so far.
struct PooledErrors {
    std::string method;
    double colour = 0, grey = 0, ownPeak = 0;
    size_t values = 0; // grey ones
    std::vector<double> photographs;

    void add(const Truth& truth, const Predictions& predicted);
    PredictionScore score() const
    {
        return {method, decibels(colour, 3 * values), decibels(grey, values), decibels(ownPeak, values), photographs};
    }
};

void PooledErrors::add(const Truth& truth, const Predictions& predicted)
{
    const size_t count = truth.heldOut.lightCount, pixels = truth.heldOut.pixels.size();
    for (size_t j = 0; j < count; ++j) {
        double sum = 0;
        const double peak = ownPeakOf(truth.heldOut, j);
        for (size_t p = 0; p < pixels; ++p) {
            const glm::vec3 &a = predicted[p * count + j], &b = truth.heldOut.radiance[p * count + j];
            for (int c = 0; c < 3; ++c) {
                sum += std::pow(clippedError(a[c], b[c], truth.peak), 2);
            }
            grey += std::pow(clippedError(greyOf(a), greyOf(b), truth.greyPeak), 2);
            ownPeak += std::pow(clippedError(greyOf(a), greyOf(b), peak), 2);
        }
        photographs.push_back(decibels(sum, 3 * pixels));
        colour += sum;
    }
    values += pixels * count;
}

Predictions predictByWeights(const Truth& truth, const std::vector<float>& weights, int threads)
{
    const size_t count = truth.heldOut.lightCount, given = truth.given.lightCount;
    Predictions predicted(truth.heldOut.radiance.size());
    parallelFor(truth.heldOut.pixels.size(), 256, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            for (size_t j = 0; j < count; ++j) {
                glm::vec3 sum(0);
                for (size_t i = 0; i < given; ++i) {
                    sum +=
                        weights[j * given + i] * truth.given.radiance[p * given + i] / truth.givenLights[i].irradiance;
                }
                predicted[p * count + j] = sum * truth.heldOutLights[j].irradiance;
            }
        }
    });
    return predicted;
}

// One baseline at each of its smoothings.
struct BaselineErrors {
    RelightingBaseline baseline;
    std::vector<PooledErrors> smoothings;

    explicit BaselineErrors(RelightingBaseline b) : baseline(b), smoothings(smoothingsOf(b).size())
    {
        for (PooledErrors& errors : smoothings) {
            errors.method = nameOf(b);
        }
    }
    void add(const Truth& truth, int threads)
    {
        const auto given = directionsOf(truth.givenLights), asked = directionsOf(truth.heldOutLights);
        for (size_t i = 0; i < smoothings.size(); ++i) {
            const Smoothing smoothing = smoothingsOf(baseline)[i];
            smoothings[i].add(truth,
                              predictByWeights(truth, relightingWeights(baseline, smoothing, given, asked), threads));
        }
    }
    // Of the smoothing that turned out best over all that was held out.
    PredictionScore best() const
    {
        const auto less = [](const PooledErrors& a, const PooledErrors& b) { return a.colour < b.colour; };
        return std::min_element(smoothings.begin(), smoothings.end(), less)->score();
    }
};

// Photograph by photograph, and the pictures of the one that is predicted worst.
void judgePhotographs(const Capture& capture, const Truth& truth, const Predictions& predicted,
                      HeldOutEvaluation& evaluation)
{
    evaluation.peak = truth.peak;
    for (size_t j = 0; j < truth.heldOut.lightCount; ++j) {
        const size_t index = evaluation.measures.size();
        const auto picture = [&](std::span<const glm::vec3> radiance) {
            return pictureOf(truth.heldOut, radiance, j, capture.width, capture.height);
        };
        const Image photograph = picture(truth.heldOut.radiance), prediction = picture(predicted);
        PhotographMeasures measures = measurePhotograph(prediction, photograph, capture.mask, truth.peak);
        measures.photograph = evaluation.photographs[index];
        evaluation.measures.push_back(measures);
        if (index == 0 || measures.psnr < evaluation.measures[evaluation.worst].psnr) {
            evaluation.worst = index;
            evaluation.worstPhotograph = photograph;
            evaluation.worstPrediction = prediction;
        }
    }
}

} // namespace

HeldOutEvaluation evaluateHeldOut(const Capture& capture, AcquireOptions options,
                                  const std::vector<RelightingBaseline>& baselines, const Progress& progress,
                                  size_t rounds)
{
    HeldOutEvaluation evaluation;
    const Rig rig = calibrateLights(capture, options.calibration);
    const int threads = options.normals.threads;
    PooledErrors nacre;
    nacre.method = "nacre";
    std::vector<BaselineErrors> others(baselines.begin(), baselines.end());
    for (size_t round = 0; round < rounds; ++round) {
        options.lights.heldOutFirst = round;
        const Stopwatch watch;
        evaluation.acquisition = acquire(capture, options, progress);
        evaluation.seconds += watch.seconds();
        const std::vector<size_t> given = chosenLights(rig.lights, options.lights);
        const std::vector<size_t> heldOut = heldOutIndices(capture.photographs.size(), options.lights);
        evaluation.given = given.size();
        for (const size_t i : heldOut) {
            evaluation.photographs.push_back(capture.photographs[i].name);
        }
        const Surface& surface = evaluation.acquisition.surface;
        const Truth truth = readTruth(capture, rig, heldOut, given, surface, options);
        const std::vector<Light> placed =
            placedLights(capture, heldOut, truth.heldOutLights, evaluation.acquisition.estimate.nearField);
        const Predictions predicted = predictBySurface(surface, truth.heldOut, placed, threads);
        nacre.add(truth, predicted);
        judgePhotographs(capture, truth, predicted, evaluation);
        for (size_t i = 0; i < others.size(); ++i) {
            progress("baselines", static_cast<double>(i) / static_cast<double>(others.size()));
            others[i].add(truth, threads);
        }
    }
    evaluation.modelBytes = modelBytes(evaluation.acquisition.surface);
    evaluation.scores.push_back(nacre.score());
    for (const BaselineErrors& baseline : others) {
        evaluation.scores.push_back(baseline.best());
    }
    return evaluation;
}

} // namespace nacre
