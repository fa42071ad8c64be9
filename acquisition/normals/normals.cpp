#include "acquisition/normals/normals.h"

#include <fmt/format.h>

#include "acquisition/normals/normal_selection.h"
#include "acquisition/normals/normals_exemplar.h"
#include "engine/scene/error.h"

namespace nacre {

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
    throw Error("", fmt::format("--normals {} is no method", name), "one of " + normalMethodNames(), Error::kUsage);
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

NormalEstimator makeNormalEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                    const NormalOptions& options, NormalReport& report)
{
    report.method = options.method == NormalMethod::automatic
                        ? selectNormalMethod(sample, lights, options, report.remarks)
                        : options.method;
    switch (report.method) {
    case NormalMethod::leastSquares:
        return makeLeastSquaresEstimator(lights, options);
    case NormalMethod::threshold:
        return makeThresholdEstimator(lights, options);
    case NormalMethod::twoStep:
        return makeTwoStepEstimator(lights, options);
    case NormalMethod::ransac:
        return makeRansacEstimator(lights, options);
    case NormalMethod::exemplar:
        return makeExemplarEstimator(sample, lights, options, report.remarks);
    case NormalMethod::automatic:
    case NormalMethod::consensus:
        break;
    }
    return makeConsensusEstimator(lights, options);
}

} // namespace nacre
