#include "acquisition/brdf/interpolation_choice.h"

#include "acquisition/brdf/held_out_planes.h"
#include "acquisition/brdf/sample_cells.h"

namespace nacre {

namespace {

// A change has to lower the error by this share, or chance would choose.
constexpr double kLeastGain = 0.99;

} // namespace

InterpolationChoice chooseInterpolation(const BrdfSamples& samples, const InterpolationOptions& start)
{
    InterpolationChoice choice{start, 0, 0, 0};
    choice.options.completed = false; // what lies between samples is judged
    const HeldOutPlanes split = holdOutPlanes(condensedSamples(usableSamples(samples), start.threads));
    choice.heldOut = split.judges.size();
    if (split.judges.size() == 0 || split.kept.size() == 0) {
        choice.options.completed = start.completed;
        return choice;
    }
    choice.error = choice.firstError = errorOf(split, makeInterpolant(split.kept, choice.options), start.threads);
    const auto consider = [&](const InterpolationOptions& candidate) {
        const double error = errorOf(split, makeInterpolant(split.kept, candidate), start.threads);
        if (error < kLeastGain * choice.error) {
            choice.options = candidate;
            choice.error = error;
        }
    };
    if (start.method == InterpolationMethod::localLinear) {
        for (const float factor : {0.25f, 0.5f, 2.0f, 4.0f}) {
            InterpolationOptions candidate = choice.options;
            candidate.metric.thetaD = factor * start.metric.thetaD;
            consider(candidate);
        }
        for (const float factor : {0.5f, 2.0f}) {
            InterpolationOptions candidate = choice.options;
            candidate.metric.azimuth = factor * start.metric.azimuth;
            consider(candidate);
        }
    }
    for (const int k : {8, 12, 50, 100}) {
        InterpolationOptions candidate = choice.options;
        candidate.k = k;
        consider(candidate);
    }
    choice.options.completed = start.completed;
    return choice;
}

} // namespace nacre
