#include "acquisition/brdf/held_out_planes.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kEvery = 6;
constexpr size_t kFewestPlanes = 8;
constexpr size_t kMostJudges = 2000;
// Radians: lights closer than this in thetaD count as one plane.
constexpr float kPlaneWidth = 0.002f;

void addSample(const BrdfSamples& from, size_t i, BrdfSamples& to)
{
    to.unit.push_back(from.unit[i]);
    to.values.push_back(from.values[i]);
    to.weights.push_back(from.weights[i]);
}

float cosineOf(const BrdfSamples& samples, size_t i)
{
    return directionsFromUnit(samples.domain, samples.unit[i]).l.z;
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

} // namespace

HeldOutPlanes holdOutPlanes(const BrdfSamples& cells)
{
    size_t planes = 0;
    const std::vector<size_t> plane = planesOf(cells, planes);
    const bool byPlane = planes >= kFewestPlanes;
    HeldOutPlanes split;
    split.areLights = byPlane;
    split.kept.domain = split.judges.domain = cells.domain;
    BrdfSamples heldOut;
    std::vector<float> values;
    for (size_t i = 0; i < cells.size(); ++i) {
        const size_t number = byPlane ? plane[i] : i;
        addSample(cells, i, number % kEvery == kEvery / 2 ? heldOut : split.kept);
        const glm::vec3 shown = cosineOf(cells, i) * cells.values[i];
        values.insert(values.end(), {shown.x, shown.y, shown.z});
    }
    const size_t judges = std::min(kMostJudges, heldOut.size());
    for (size_t j = 0; j < judges; ++j) {
        addSample(heldOut, (2 * j + 1) * heldOut.size() / (2 * judges), split.judges);
        split.cosines.push_back(cosineOf(split.judges, j));
    }
    split.peak = peakOf(values);
    return split;
}

double errorOf(const HeldOutPlanes& split, const BrdfInterpolant& interpolant, int threads)
{
    std::vector<double> squares(split.judges.size());
    parallelFor(squares.size(), 64, threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            const auto shown = [&](const glm::vec3& v) {
                return glm::clamp(v * split.cosines[i] / split.peak, 0.0f, 1.0f);
            };
            const glm::vec3 miss = shown(interpolant(split.judges.unit[i]).value) - shown(split.judges.values[i]);
            squares[i] = glm::dot(miss, miss) / 3;
        }
    });
    double sum = 0, weights = 0;
    for (size_t i = 0; i < squares.size(); ++i) {
        const double trust = split.judges.weights[i] / split.cosines[i];
        sum += trust * trust * squares[i];
        weights += trust * trust;
    }
    return std::sqrt(sum / weights);
}

} // namespace nacre
