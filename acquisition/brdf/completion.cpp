#include "acquisition/brdf/completion.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "acquisition/brdf/local_linear.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr float kInnerShare = 0.7f;
constexpr size_t kMostTrustJudges = 2000;
// Of the expected error, see completion.h; distances and normals in radians.
constexpr float kLeastToldError = 0.02f, kOfDeviation = 2, kOfMove = 0.3f, kOfDistance = 0.2f, kOfNormals = 0.02f;
constexpr float kLeastToldCosine = 0.05f;
// Keeps logarithms finite.
constexpr float kLeastValue = 1e-9f;

float largestThetaD(const BrdfSamples& samples)
{
    float largest = 0;
    for (const glm::vec3& unit : samples.unit) {
        largest = std::max(largest, unit.y);
    }
    return largest;
}

BrdfInterpolant ratioToPrior(BrdfSamples samples, const InterpolationOptions& options, const ConditionedPrior& prior)
{
    for (size_t i = 0; i < samples.size(); ++i) {
        samples.values[i] /= prior.evaluate(samples.domain, samples.unit[i]);
    }
    const auto regression = std::make_shared<const LocalLinearRegression>(samples, options.metric, options.k);
    return [regression](const glm::vec3& unit) { return regression->evaluate(unit); };
}

glm::vec3 powerOf(const glm::vec3& value, float exponent)
{
    return glm::pow(glm::max(value, glm::vec3(0)), glm::vec3(exponent));
}

float fadeAt(float distance)
{
    const float share = distance / CompletedBrdf::kFade;
    return std::exp(-0.5f * share * share);
}

// r: the ratio to the prior at the border, that is at the least of unit's thetaD and `reach`.
CompletedBrdf::Extrapolation extrapolated(const TableDomain& domain, const ConditionedPrior& prior,
                                          const InterpolatedValue& r, float reach, const glm::vec3& unit)
{
    const glm::vec3 border(unit.x, std::min(unit.y, reach), unit.z);
    const float nearest = glm::length(glm::vec2(r.nearest, (unit.y - border.y) * domain.thetaDMax));
    return {prior.evaluate(domain, border) * powerOf(r.value, fadeAt(r.nearest)),
            prior.evaluate(domain, unit) * powerOf(r.value, fadeAt(nearest)), nearest};
}

BrdfSamples samplesWhere(const BrdfSamples& samples, bool inner, float border)
{
    BrdfSamples taken;
    taken.domain = samples.domain;
    for (size_t i = 0; i < samples.size(); ++i) {
        if ((samples.unit[i].y < border) == inner) {
            taken.unit.push_back(samples.unit[i]);
            taken.values.push_back(samples.values[i]);
            taken.weights.push_back(samples.weights[i]);
        }
    }
    return taken;
}

// Of each sample f n.l over its 99th percentile, at most 1, squared: how an error there shows.
std::vector<float> shownWeights(const BrdfSamples& samples)
{
    std::vector<float> radiance(samples.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        const float cosine = directionsFromUnit(samples.domain, samples.unit[i]).l.z;
        radiance[i] = std::max(0.0f, glm::dot(samples.values[i], glm::vec3(cosine / 3)));
    }
    std::vector<float> sorted = radiance;
    const auto bright = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 99 / 100);
    std::nth_element(sorted.begin(), bright, sorted.end());
    for (float& r : radiance) {
        r = *bright > 0 ? std::min(r / *bright, 1.0f) : 0.0f;
        r *= r;
    }
    return radiance;
}

} // namespace

CompletedBrdf::CompletedBrdf(const BrdfSamples& samples, const InterpolationOptions& options,
                             const MaterialPrior& prior)
    : domain_(samples.domain), prior_(conditionedPrior(prior, samples)), ratio_(ratioToPrior(samples, options, prior_)),
      reach_(largestThetaD(samples)), borderSize_(kThetaHTexels, phiDTexels(samples.domain))
{
    if (reach_ < 1) {
        trust_ = trustInPrior(samples, options, prior);
        borderRatios_.resize(static_cast<size_t>(borderSize_.x) * borderSize_.y);
        parallelFor(borderRatios_.size(), 64, options.threads, [&](size_t first, size_t end) {
            for (size_t i = first; i < end; ++i) {
                const auto x = static_cast<int>(i) % borderSize_.x, y = static_cast<int>(i) / borderSize_.x;
                const glm::vec2 place = glm::vec2(x, y) / glm::vec2(borderSize_ - 1);
                borderRatios_[i] = ratio_({place.x, reach_, place.y});
            }
        });
    }
}

InterpolatedValue CompletedBrdf::ratioAtBorder(const glm::vec3& unit) const
{
    const glm::vec2 position = glm::vec2(unit.x, unit.z) * glm::vec2(borderSize_ - 1);
    const glm::ivec2 low = glm::clamp(glm::ivec2(position), glm::ivec2(0), borderSize_ - 2);
    const glm::vec2 t = position - glm::vec2(low);
    InterpolatedValue sum;
    for (int corner = 0; corner < 4; ++corner) {
        const int i = corner & 1, j = corner >> 1;
        const float weight = (i ? t.x : 1 - t.x) * (j ? t.y : 1 - t.y);
        const InterpolatedValue& node =
            borderRatios_[static_cast<size_t>(low.y + j) * borderSize_.x + static_cast<size_t>(low.x + i)];
        sum.value += weight * node.value;
        sum.nearest += weight * node.nearest;
    }
    return sum;
}

InterpolatedValue CompletedBrdf::evaluate(const glm::vec3& unit) const
{
    const bool isBeyond = unit.y > reach_;
    const CompletedBrdf::Extrapolation e =
        extrapolated(domain_, prior_, isBeyond ? ratioAtBorder(unit) : ratio_(unit), reach_, unit);
    const glm::vec3 value = isBeyond ? powerOf(e.border, 1 - trust_) * powerOf(e.prior, trust_) : e.prior;
    return {value, e.nearest, expectedError(unit, e, value)};
}

float CompletedBrdf::expectedError(const glm::vec3& unit, const Extrapolation& e, const glm::vec3& value) const
{
    const float fade = fadeAt(e.nearest), misfit = prior_.misfit * prior_.misfit;
    const float faded = (1 - fade * fade) * (prior_.variance(domain_, unit) + misfit);
    const float moved = std::log(std::max(greyOf(value), kLeastValue) / std::max(greyOf(e.border), kLeastValue));
    const LightView d = directionsFromUnit(domain_, unit);
    const float cosine = std::clamp(std::min(d.l.z, d.v.z), kLeastToldCosine, 1.0f);
    const auto square = [](float x) { return x * x; };
    return std::sqrt(square(kLeastToldError) + square(kOfDeviation) * faded + square(kOfMove * moved) +
                     square(kOfDistance * e.nearest) + misfit + square(kOfNormals) * (1 / square(cosine) - 1));
}

float trustInPrior(const BrdfSamples& samples, const InterpolationOptions& options, const MaterialPrior& prior)
{
    const float border = kInnerShare * largestThetaD(samples);
    const BrdfSamples inner = samplesWhere(samples, true, border), judges = samplesWhere(samples, false, border);
    if (inner.size() == 0) {
        return 1;
    }
    const ConditionedPrior conditioned = conditionedPrior(prior, inner);
    const BrdfInterpolant ratio = ratioToPrior(inner, options, conditioned);
    const float reach = largestThetaD(inner);
    const std::vector<float> weights = shownWeights(judges);
    const size_t step = std::max<size_t>(1, judges.size() / kMostTrustJudges);
    double gained = 0, moved = 0;
    for (size_t i = 0; i < judges.size(); i += step) {
        const CompletedBrdf::Extrapolation e = extrapolated(
            judges.domain, conditioned, ratio({judges.unit[i].x, reach, judges.unit[i].z}), reach, judges.unit[i]);
        const auto logOf = [](const glm::vec3& v) { return glm::log(glm::max(v, glm::vec3(kLeastValue))); };
        const glm::vec3 start = logOf(e.border), move = logOf(e.prior) - start;
        gained += weights[i] * glm::dot(logOf(judges.values[i]) - start, move);
        moved += weights[i] * glm::dot(move, move);
    }
    return moved > 0 ? static_cast<float>(std::clamp(gained / moved, 0.0, 1.0)) : 1.0f;
}

} // namespace nacre
