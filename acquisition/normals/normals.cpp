#include "acquisition/normals/normals.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// A shadow is at least this share darker than the model, whatever the scatter says: cast shadows are.
constexpr float kShadowShare = 0.5f;

float toleranceOf(std::span<const float> observed, std::span<const float> predicted)
{
    thread_local std::vector<float> residuals;
    residuals.clear();
    for (size_t i = 0; i < observed.size(); ++i) {
        if (predicted[i] > 0 && !isClipped(observed[i])) {
            residuals.push_back(std::abs(observed[i] - predicted[i]));
        }
    }
    const float scatter = residuals.empty() ? 0.0f : 3 * 1.4826f * quantile(residuals, 0.5);
    return std::max(scatter, kLeastTolerance * brightLevel(observed));
}

} // namespace

void judge(std::span<const float> observed, std::span<const float> predicted, std::span<Verdict> verdicts)
{
    const float tolerance = toleranceOf(observed, predicted);
    for (size_t i = 0; i < observed.size(); ++i) {
        const float difference = observed[i] - predicted[i];
        const bool dark = difference < -tolerance && observed[i] < kShadowShare * predicted[i];
        verdicts[i] = isClipped(observed[i])      ? Verdict::saturated
                      : predicted[i] <= 0 || dark ? Verdict::shadow
                      : difference > tolerance    ? Verdict::highlight
                                                  : Verdict::used;
    }
}

float normalUncertainty(float residualScatter, float albedo, float inverseGramTrace)
{
    const float error = residualScatter * std::sqrt(inverseGramTrace) / albedo;
    return std::isfinite(error) ? error : std::numeric_limits<float>::infinity();
}

float confidenceOf(float uncertainty)
{
    const float ratio = uncertainty / kHalfConfidence;
    return std::isfinite(ratio) ? 1 / (1 + ratio * ratio) : 0.0f;
}

namespace {

struct NamedMethod {
    const char* name;
    NormalMethod method;
};

constexpr NamedMethod kMethods[] = {
    {"auto", NormalMethod::automatic},      {"least-squares", NormalMethod::leastSquares},
    {"threshold", NormalMethod::threshold}, {"two-step", NormalMethod::twoStep},
    {"ransac", NormalMethod::ransac},       {"consensus", NormalMethod::consensus},
    {"exemplar", NormalMethod::exemplar}};

} // namespace

std::string normalMethodNames()
{
    std::string names;
    for (const NamedMethod& method : kMethods) {
        names += (names.empty() ? "" : ", ") + std::string(method.name);
    }
    return names;
}

NormalMethod normalMethodFromName(const std::string& name)
{
    for (const NamedMethod& method : kMethods) {
        if (name == method.name) {
            return method.method;
        }
    }
    throw Error("", fmt::format("'{}' is no method for normals", name), "one of " + normalMethodNames(), Error::kUsage);
}

std::string nameOf(NormalMethod method)
{
    for (const NamedMethod& named : kMethods) {
        if (named.method == method) {
            return named.name;
        }
    }
    return {};
}

} // namespace nacre
