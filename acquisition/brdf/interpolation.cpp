#include "acquisition/brdf/interpolation.h"

#include <memory>

#include "acquisition/brdf/completion.h"
#include "acquisition/brdf/kernel_regression.h"
#include "acquisition/brdf/local_linear.h"
#include "acquisition/brdf/sample_cells.h"
#include "engine/files/error.h"

namespace nacre {

InterpolationMethod interpolationMethodFromName(const std::string& name)
{
    for (const auto method : {InterpolationMethod::localLinear, InterpolationMethod::paper}) {
        if (name == nameOf(method)) {
            return method;
        }
    }
    throw Error("", "interpolation " + name + " is unknown", "local-linear or paper", Error::kUsage);
}

std::string nameOf(InterpolationMethod method)
{
    return method == InterpolationMethod::paper ? "paper" : "local-linear";
}

BrdfInterpolant makeInterpolant(const BrdfSamples& samples, const InterpolationOptions& options)
{
    if (options.k < 1 || options.k > kMostNeighbours) {
        throw Error("", std::to_string(options.k) + " nearest samples are out of range",
                    "1 to " + std::to_string(kMostNeighbours), Error::kUsage);
    }
    if (options.method == InterpolationMethod::paper) {
        const auto regression = std::make_shared<const KernelRegression>(samples, options.k);
        return [regression](const glm::vec3& unit) { return regression->evaluate(unit); };
    }
    const BrdfSamples cells = condensedSamples(usableSamples(samples), options.threads);
    if (options.completed && samples.domain.coordinates != kNatural) {
        const auto whole = std::make_shared<const CompletedBrdf>(cells, options, publishedMaterialPrior());
        return [whole](const glm::vec3& unit) { return whole->evaluate(unit); };
    }
    const auto regression = std::make_shared<const LocalLinearRegression>(cells, options.metric, options.k);
    return [regression](const glm::vec3& unit) { return regression->evaluate(unit); };
}

} // namespace nacre
