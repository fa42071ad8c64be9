#pragma once
#include "acquisition/chain/acquire_options.h"
#include "evaluation/stress/stress_estimate.h"

namespace nacre {

struct BrdfError {
    double percent = 0;
    double meanConfidence = 0; // of the table, where it was asked
};

// How far a material is from the truth that was photographed. It is sampled from the estimate and baked, and predicts
// the undegraded photographs under their true lights and with their true normals: the sum of |prediction - photograph|
// over that of the photographs, in percent. Lit observations count, and each pixel has the factor that suits it best,
// as its albedo is not the material's.
BrdfError brdfError(const StressPhotographs& photographs, const NormalBlock& normals,
                    const PhotographedObject& undegraded, const AcquireOptions& options);

} // namespace nacre
