#include "acquisition/brdf/interpolation_choice.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/brdf/sample_cells.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kEvery = 6;
constexpr size_t kFewestPlanes = 8;
constexpr size_t kMostJudges = 2000;
// Radians: lights closer than this in thetaD count as one plane.
constexpr float kPlaneWidth = 0.002f;
// A change has to lower the error by this share, or chance would choose.
constexpr double kLeastGain = 0.99;

struct Split {
    BrdfSamples kept, judges;
    float peak = 1; // 99th percentile of the values
};

void addSample(const BrdfSamples& from, size_t i, BrdfSamples& to)
{
    to.unit.push_back(from.unit[i]);
    to.values.push_back(from.values[i]);
    to.weights.push_back(from.weights[i]);
}

// The rank of each sample's plane of thetaD among all, and how many there are. Natural coordinates: planes of thetaO.
std::vector<size_t> planesOf(const BrdfSamples& samples, size_t& count)
{
    const float perPlane = (samples.domain.coordinates == kNatural ? kHalfPi : samples.domain.thetaDMax) / kPlaneWidth;
    std::vector<int> plane(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        plane[i] = static_cast<int>(std::lround(samples.unit[i].y * perPlane));
    }
    std::vector<int> different = plane;
    std::sort(different.begin(), different.end());
    different.erase(std::unique(different.begin(), different.end()), different.end());
    count = different.size();
    std::vector<size_t> rank(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        rank[i] =
            static_cast<size_t>(std::lower_bound(different.begin(), different.end(), plane[i]) - different.begin());
    }
    return rank;
}

Split splitSamples(const BrdfSamples& cells)
{
    size_t planes = 0;
    const std::vector<size_t> plane = planesOf(cells, planes);
    const bool byPlane = planes >= kFewestPlanes;
    Split split;
    split.kept.domain = split.judges.domain = cells.domain;
    BrdfSamples heldOut;
    std::vector<float> values;
    for (size_t i = 0; i < cells.size(); ++i) {
        const size_t number = byPlane ? plane[i] : i;
        addSample(cells, i, number % kEvery == kEvery / 2 ? heldOut : split.kept);
        values.insert(values.end(), {cells.values[i].x, cells.values[i].y, cells.values[i].z});
    }
    const size_t judges = std::min(kMostJudges, heldOut.size());
    for (size_t j = 0; j < judges; ++j) {
        addSample(heldOut, (2 * j + 1) * heldOut.size() / (2 * judges), split.judges);
    }
    split.peak = peakOf(values);
    return split;
}

double errorOf(const Split& split, const InterpolationOptions& options)
{
    const BrdfInterpolant interpolant = makeInterpolant(split.kept, options);
    std::vector<double> squares(split.judges.size());
    parallelFor(squares.size(), 64, options.threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const auto shown = [&](const glm::vec3& v) { return glm::clamp(v / split.peak, 0.0f, 1.0f); };
            const glm::vec3 miss = shown(interpolant(split.judges.unit[i]).value) - shown(split.judges.values[i]);
            squares[i] = glm::dot(miss, miss) / 3;
        }
    });
    double sum = 0;
    for (const double square : squares) {
        sum += square;
    }
    return std::sqrt(sum / static_cast<double>(squares.size()));
}

} // namespace

InterpolationChoice chooseInterpolation(const BrdfSamples& samples, const InterpolationOptions& start)
{
    InterpolationChoice choice{start, 0, 0, 0};
    choice.options.completed = false; // what lies between samples is judged
    const Split split = splitSamples(condensedSamples(usableSamples(samples), start.threads));
    choice.heldOut = split.judges.size();
    if (split.judges.size() == 0 || split.kept.size() == 0) {
        choice.options.completed = start.completed;
        return choice;
    }
    choice.error = choice.firstError = errorOf(split, choice.options);
    const auto consider = [&](const InterpolationOptions& candidate) {
        const double error = errorOf(split, candidate);
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
