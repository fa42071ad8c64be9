#pragma once
#include <string>
#include <vector>

#include "acquisition/capture/finding.h"
#include "acquisition/chain/acquire_options.h"

namespace nacre {

// Pixels from all over an object, and what is known of its photographs.
struct CaptureSample {
    Observations seen;
    std::vector<std::string> photographs; // names, one per light
    bool irradiancesKnown = false;
    std::vector<Light> lights;
};

struct ReconciledPhotographs {
    CaptureSample sample;             // of the photographs that agree, irradiances corrected by what the rest say
    std::vector<size_t> agreeing;     // these photographs, as indices into those that were given
    std::vector<std::string> leftOut; // names of the others
    std::vector<Finding> findings;
    std::vector<CheckFigure> figures; // of the self-checks of values
};

// Leaves out photographs that no intensity reconciles with the others, and corrects irradiances. Where
// options.correctIntensities is off, or too little is there to compare, all stay as they are.
ReconciledPhotographs reconcilePhotographs(CaptureSample sample, const AcquireOptions& options);

} // namespace nacre
