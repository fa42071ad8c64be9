#include <memory>

#include "acquisition/normals/lambertian_solver.h"

namespace nacre {

// All observations alike: attached shadows and highlights are taken for data.
NormalEstimator makeLeastSquaresEstimator(const std::vector<Light>& lights, const NormalOptions& options)
{
    const auto solver = std::make_shared<LambertianSolver>(lights);
    return [solver, options](const Intensities& intensities) {
        return solveBlock(intensities, *solver, options.threads,
                          [&](size_t, std::span<const float> observed) { return solver->solve(observed); });
    };
}

} // namespace nacre
