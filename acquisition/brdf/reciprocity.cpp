#include "acquisition/brdf/reciprocity.h"

#include <cmath>
#include <utility>

#include "acquisition/brdf/held_out_planes.h"
#include "acquisition/brdf/sample_cells.h"

namespace nacre {

BrdfSamples reciprocalSamples(BrdfSamples oneWay)
{
    for (glm::vec3& unit : oneWay.unit) {
        unit.z = 1 - std::abs(1 - 2 * unit.z); // phiD and pi - phiD are one
    }
    oneWay.domain.coordinates = kHalfDifference;
    return oneWay;
}

std::optional<double> errorRatioOneWay(const BrdfSamples& oneWay, const InterpolationOptions& options)
{
    InterpolationOptions measured = options;
    measured.completed = false; // what lies between samples is judged
    HeldOutPlanes planes = holdOutPlanes(condensedSamples(usableSamples(oneWay), options.threads));
    if (!planes.areLights || planes.judges.size() == 0 || planes.kept.size() == 0) {
        return {};
    }
    const double apart = errorOf(planes, makeInterpolant(planes.kept, measured), options.threads);
    planes.kept = reciprocalSamples(std::move(planes.kept));
    planes.judges = reciprocalSamples(std::move(planes.judges));
    const double asOne = errorOf(planes, makeInterpolant(planes.kept, measured), options.threads);
    return asOne > 0 ? std::optional(apart / asOne) : std::nullopt;
}

} // namespace nacre
