#include "evaluation/held_out.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "acquisition/normals/light_triples.h"
#include "engine/scene/measures.h"
#include "engine/scene/parallel_for.h"

namespace nacre {

namespace {

struct Truth {
    Observations heldOut, given;
    std::vector<Light> heldOutLights, givenLights;
    double peak = 1, greyPeak = 1; // 99th percentiles
};

double percentile99(const Observations& all, bool grey)
{
    std::vector<float> values;
    for (const glm::vec3& v : all.radiance) {
        if (grey) {
            values.push_back(greyOf(v));
        } else {
            values.insert(values.end(), {v.x, v.y, v.z});
        }
    }
    return values.empty() ? 1.0 : std::max(quantile(values, 0.99), 1e-12f);
}

std::vector<size_t> heldOutOf(size_t photographs, size_t every)
{
    std::vector<size_t> heldOut;
    for (size_t i = 0; i < photographs; ++i) {
        if (isHeldOutOfEvery(i, every)) {
            heldOut.push_back(i);
        }
    }
    return heldOut;
}

Truth readTruth(const Capture& capture, const Rig& rig, const std::vector<size_t>& heldOut,
                const std::vector<size_t>& given, int threads)
{
    ObservationReader reader(capture, threads, ~size_t{0});
    Observations all;
    reader.next(all);
    return {selectLights(all, heldOut),      selectLights(all, given), selectLights(rig, heldOut).lights,
            selectLights(rig, given).lights, percentile99(all, false), percentile99(all, true)};
}

double ownPeakOf(const Observations& seen, size_t photograph)
{
    std::vector<float> values;
    for (size_t p = 0; p < seen.pixels.size(); ++p) {
        values.push_back(greyOf(seen.radianceOf(p)[photograph]));
    }
    return values.empty() ? 1.0 : std::max(quantile(values, 0.99), 1e-12f);
}

PredictionScore scoreOf(const std::string& method, const Truth& truth, const Predictions& predicted)
{
    const size_t count = truth.heldOut.lightCount, pixels = truth.heldOut.pixels.size();
    PredictionScore score{method, 0, 0, 0, {}};
    double pooled = 0, grey = 0, ownPeak = 0;
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
        score.photographs.push_back(decibels(sum, 3 * pixels));
        pooled += sum;
    }
    score.psnr = decibels(pooled, 3 * pixels * count);
    score.greyPsnr = decibels(grey, pixels * count);
    score.ownPeakPsnr = decibels(ownPeak, pixels * count);
    return score;
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

PredictionScore bestScoreOf(RelightingBaseline baseline, const Truth& truth, int threads)
{
    const auto given = directionsOf(truth.givenLights), asked = directionsOf(truth.heldOutLights);
    PredictionScore best;
    for (const Smoothing& smoothing : smoothingsOf(baseline)) {
        const std::vector<float> weights = relightingWeights(baseline, smoothing, given, asked);
        const PredictionScore score = scoreOf(nameOf(baseline), truth, predictByWeights(truth, weights, threads));
        if (best.method.empty() || score.psnr > best.psnr) {
            best = score;
        }
    }
    return best;
}

// Photograph by photograph, and the pictures of the one that is predicted worst.
void judgePhotographs(const Capture& capture, const Truth& truth, const Predictions& predicted,
                      HeldOutEvaluation& evaluation)
{
    evaluation.peak = truth.peak;
    for (size_t j = 0; j < truth.heldOut.lightCount; ++j) {
        const auto picture = [&](std::span<const glm::vec3> radiance) {
            return pictureOf(truth.heldOut, radiance, j, capture.width, capture.height);
        };
        const Image photograph = picture(truth.heldOut.radiance), prediction = picture(predicted);
        PhotographMeasures measures = measurePhotograph(prediction, photograph, capture.mask, truth.peak);
        measures.photograph = evaluation.photographs[j];
        evaluation.measures.push_back(measures);
        if (j == 0 || measures.psnr < evaluation.measures[evaluation.worst].psnr) {
            evaluation.worst = j;
            evaluation.worstPhotograph = photograph;
            evaluation.worstPrediction = prediction;
        }
    }
}

} // namespace

HeldOutEvaluation evaluateHeldOut(const Capture& capture, const AcquireOptions& options,
                                  const std::vector<RelightingBaseline>& baselines, const Progress& progress)
{
    HeldOutEvaluation evaluation;
    const Rig rig = calibrateLights(capture, options.calibration);
    const std::vector<size_t> heldOut = heldOutOf(capture.photographs.size(), options.lights.heldOutEvery);
    const auto start = std::chrono::steady_clock::now();
    evaluation.acquisition = acquire(capture, options, progress);
    evaluation.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::vector<size_t> given = chosenLights(rig.lights, options.lights);
    evaluation.given = given.size();
    for (const size_t i : heldOut) {
        evaluation.photographs.push_back(capture.photographs[i].name);
    }
    const int threads = options.normals.threads;
    const Truth truth = readTruth(capture, rig, heldOut, given, threads);
    const Surface& surface = evaluation.acquisition.surface;
    const Predictions predicted = predictBySurface(surface, truth.heldOut, truth.heldOutLights, threads);
    evaluation.scores.push_back(scoreOf("nacre", truth, predicted));
    judgePhotographs(capture, truth, predicted, evaluation);
    evaluation.modelBytes = modelBytes(surface);
    for (const RelightingBaseline baseline : baselines) {
        progress("baselines",
                 static_cast<double>(evaluation.scores.size()) / static_cast<double>(baselines.size() + 1));
        evaluation.scores.push_back(bestScoreOf(baseline, truth, threads));
    }
    return evaluation;
}

} // namespace nacre
