#pragma once
#include <optional>
#include <string>
#include <vector>

#include "acquisition/chain/block_walk.h"
#include "acquisition/chain/chosen_method.h"
#include "acquisition/near_field/as_if_distant.h"

namespace nacre {

// How the observations under one light were judged.
struct VerdictCounts {
    size_t used = 0, shadow = 0, highlight = 0, saturated = 0;
};

// Normals alone: the first half of the chain.
struct NormalEstimate {
    std::vector<size_t> given;          // the photographs that normals rest on, as indices into the capture's
    Rig rig;                            // of these alone
    std::optional<NearField> nearField; // where they stand; none: they are distant, the camera is orthographic
    NormalMap normals;
    NormalReport report;
    std::vector<std::string> leftOut;    // photographs that disagree with the rest, by name
    size_t pixelsWithoutNormal = 0;      // of the mask
    size_t pixelsInShade = 0;            // that fewer than three lights reach
    size_t pixelsSmoothed = 0;           // of the capture's marked ones
    std::vector<VerdictCounts> verdicts; // per light
    std::vector<uint32_t> pixels;        // of the mask, and
    std::vector<Verdict> everyVerdict;   // [pixel * lights + light]; both empty unless kept
    std::vector<StageTime> times;
};

// A capture that is ready for normals: read, calibrated, its photographs reconciled and checked against each other.
struct PreparedCapture {
    ObservationBlocks blocks;  // of the photographs in use
    std::vector<size_t> given; // these, as indices into the capture's photographs
    Rig rig;                   // of these, irradiances as corrected
    ReconciledPhotographs reconciled;
    CheckedSample checked;
    double lambertianMisfit = 0;        // see lambertian_misfit.h
    std::optional<NearField> nearField; // none: lights are distant, the camera is orthographic
    SurfaceGuess guess;                 // what nearField has to know of the surface
    std::vector<Finding> placed;        // how nearField is known
    int threads = 0;

    LocalLights localLights() const;
};

// An estimate without normals yet: what was found out before any.
NormalEstimate startEstimate(const PreparedCapture& prepared, const ChosenMethod& chosen);
// A block's normals, in the camera frame. Pixels that the capture marks to be smoothed over get none, so no samples
// either.
NormalBlock estimateNormals(const PreparedCapture& prepared, const ChosenMethod& chosen, const Segmentation& materials,
                            const Observations& block);
void storeNormals(const Observations& block, const NormalBlock& normals, bool keepVerdicts, NormalEstimate& estimate);
// What can be said of the whole map, and marked pixels smoothed in.
void finishEstimate(const Capture& capture, NormalEstimate& estimate);

} // namespace nacre
