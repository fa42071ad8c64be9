#include "engine/brdf/brdf_comparison.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "engine/files/measures.h"

namespace nacre {
namespace {

constexpr float kLeastComparedCosine = 0.05f; // 87 degrees
constexpr double kComparedShare = 0.01;       // of the peak: below, a relative error says nothing that is seen

// Halton, On the efficiency of certain quasi-random sequences, 1960.
float radicalInverse(size_t index, size_t base)
{
    double fraction = 1, value = 0;
    for (; index > 0; index /= base) {
        fraction /= static_cast<double>(base);
        value += fraction * static_cast<double>(index % base);
    }
    return static_cast<float>(value);
}

double psnrOf(const std::vector<glm::vec3>& values, const std::vector<glm::vec3>& reference, double scale)
{
    double sum = 0;
    for (size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double d = std::clamp(values[i][c] / scale, 0.0, 1.0) - std::clamp(reference[i][c] / scale, 0.0, 1.0);
            sum += d * d;
        }
    }
    return sum == 0 ? std::numeric_limits<double>::infinity()
                    : -10 * std::log10(sum / (3 * static_cast<double>(values.size())));
}

} // namespace

BrdfFunction functionOf(const BrdfModel& model)
{
    return [model](const glm::vec3& l, const glm::vec3& v) { return evaluateCovered(model, {0, 0, 1}, l, v); };
}

std::vector<LightView> comparisonConfigurations(size_t count)
{
    std::vector<LightView> configurations;
    for (size_t i = 1; i <= count; ++i) {
        HalfDifference c =
            halfDifferenceFromUnit({radicalInverse(i, 2), radicalInverse(i, 3), 0}, {kHalfDifference, kHalfPi});
        c.phiD = (2 * radicalInverse(i, 5) - 1) * kPi;
        const LightView d = directionsFromHalfDifference(c);
        if (d.l.z >= kLeastComparedCosine && d.v.z >= kLeastComparedCosine) {
            configurations.push_back(d);
        }
    }
    return configurations;
}

BrdfComparison compareBrdfs(const BrdfFunction& f, const BrdfFunction& reference, size_t count)
{
    std::vector<glm::vec3> values, expected;
    const std::vector<LightView> configurations = comparisonConfigurations(count);
    for (const LightView& d : configurations) {
        const BrdfValue a = f(d.l, d.v), b = reference(d.l, d.v);
        if (std::min(a.confidence, b.confidence) >= kCoveredConfidence) {
            values.push_back(a.value);
            expected.push_back(b.value);
        }
    }
    BrdfComparison comparison;
    if (!values.empty()) {
        comparison = compareValues(values, expected);
    }
    comparison.outOf = configurations.size();
    return comparison;
}

BrdfComparison compareValues(const std::vector<glm::vec3>& values, const std::vector<glm::vec3>& reference)
{
    assert(!values.empty() && values.size() == reference.size());
    BrdfComparison comparison{.configurations = values.size()};
    std::vector<float> numbers;
    for (const glm::vec3& f : reference) {
        numbers.insert(numbers.end(), {f.x, f.y, f.z});
    }
    comparison.peak = *std::max_element(numbers.begin(), numbers.end());
    comparison.psnr = psnrOf(values, reference, peakOf(numbers));
    const double least = comparison.peak > 0 ? kComparedShare * comparison.peak : 1;
    std::vector<float> errors;
    for (size_t i = 0; i < values.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double error = std::abs(static_cast<double>(values[i][c]) - reference[i][c]);
            errors.push_back(static_cast<float>(error / std::max<double>(reference[i][c], least)));
        }
    }
    comparison.median = quantile(errors, 0.5);
    comparison.percentile95 = quantile(errors, 0.95);
    return comparison;
}

} // namespace nacre
