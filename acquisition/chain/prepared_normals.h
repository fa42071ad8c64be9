#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire_options.h"
#include "acquisition/checks/self_checks.h"

namespace nacre {

// Pixels from all over an object, and what is known of its photographs.
struct CaptureSample {
    Observations seen;
    std::vector<std::string> photographs; // names, one per light
    bool irradiancesKnown = false;
    std::vector<Light> lights;
    int width = 0; // of the grid that seen.pixels count in; 0 where it is not known
};

// How normals are to be estimated, once the photographs were compared with each other.
struct PreparedNormals {
    std::vector<size_t> agreeing; // photographs that are used
    std::vector<Light> lights;    // of those, with irradiances corrected
    CheckedSample checked;        // of those photographs
    NormalReport report;
    NormalEstimator estimator;
};

// Leaves out photographs that cannot be reconciled with the others, the sample's too, and corrects irradiances by what
// the rest say; the estimator is not made.
PreparedNormals preparePhotographs(CaptureSample& capture, const AcquireOptions& options);
// Makes the estimator of the options' method for prepared photographs, the sample's being those that are left, and says
// what is doubtful about it.
void completeNormals(const CaptureSample& capture, const AcquireOptions& options, PreparedNormals& prepared);
// Both steps from observations to normals, for observations that stand in no file as well; blocks hold the agreeing
// photographs alone.
PreparedNormals prepareNormals(CaptureSample capture, const AcquireOptions& options);
NormalBlock estimateBlock(const NormalEstimator& estimator, const Observations& block,
                          const std::vector<Light>& lights);

} // namespace nacre
