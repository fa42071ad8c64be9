#include "acquisition/exemplar/normal_method.h"

#include "acquisition/exemplar/normal_selection.h"
#include "acquisition/exemplar/normals_exemplar.h"

namespace nacre {

NormalEstimator makeNormalEstimator(const Intensities& sample, const std::vector<Light>& lights,
                                    const NormalOptions& options, NormalReport& report)
{
    report.method = options.method == NormalMethod::automatic
                        ? selectNormalMethod(sample, lights, options, report.findings)
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
        return makeExemplarEstimator(sample, lights, options, report.findings);
    case NormalMethod::automatic:
    case NormalMethod::consensus:
        break;
    }
    return makeConsensusEstimator(lights, options);
}

} // namespace nacre
