#pragma once
#include <vector>

#include "acquisition/chain/chosen_method.h"
#include "evaluation/held_out/photographed_object.h"

namespace nacre {

// An object's photographs after what does not depend on the method of normals.
struct StressPhotographs {
    ReconciledPhotographs reconciled;
    CheckedSample checked;
    Observations seen; // of the photographs in use
};
// Throws Error where the program refuses, as estimateNormals does.
StressPhotographs preparedPhotographs(const PhotographedObject& object, const AcquireOptions& options);

// The normals that the program finds, and what it warns of.
struct StressEstimate {
    NormalBlock block;
    std::vector<Finding> warnings;
};

// The chain as `nacre normals` runs it, from the photographs on.
StressEstimate estimateNormals(const PhotographedObject& object, const StressPhotographs& photographs,
                               const AcquireOptions& options);

} // namespace nacre
