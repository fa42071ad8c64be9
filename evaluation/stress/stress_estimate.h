#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/prepared_normals.h"
#include "evaluation/held_out/photographed_object.h"

namespace nacre {

// An object's photographs as the program takes them: without those that it left out, and the normals that it found.
struct StressEstimate {
    Observations seen;
    PreparedNormals prepared;
    NormalBlock block;
    std::vector<std::string> warnings;
};

// Photographs after what does not depend on the method of normals.
struct StressPhotographs {
    CaptureSample sample;
    PreparedNormals prepared;
};
// Throws Error where the program refuses, as estimateNormals does.
StressPhotographs preparedPhotographs(const PhotographedObject& object, const AcquireOptions& options);

// The chain as `nacre normals` runs it, from the photographs on.
StressEstimate estimateNormals(const PhotographedObject& object, const StressPhotographs& photographs,
                               const AcquireOptions& options);

} // namespace nacre
