#pragma once
#include <functional>
#include <string>
#include <vector>

#include "acquisition/capture/capture.h"
#include "acquisition/chain/acquire_options.h"
#include "acquisition/chain/prepared_normals.h"
#include "acquisition/chain/stage_clock.h"
#include "acquisition/segmentation/segmentation.h"

namespace nacre {

// How the observations under one light were judged.
struct VerdictCounts {
    size_t used = 0, shadow = 0, highlight = 0, saturated = 0;
};

// Normals alone: the first half of the chain.
struct NormalEstimate {
    std::vector<size_t> given; // the photographs that normals rest on, as indices into the capture's
    Rig rig;                   // of these alone
    NormalMap normals;
    NormalReport report;
    std::vector<std::string> leftOut;    // photographs that disagree with the rest, by name
    size_t pixelsWithoutNormal = 0;      // of the mask
    size_t pixelsSmoothed = 0;           // of the capture's marked ones
    std::vector<VerdictCounts> verdicts; // per light
    std::vector<uint32_t> pixels;        // of the mask, and
    std::vector<Verdict> everyVerdict;   // [pixel * lights + light]; both empty unless kept
    std::vector<StageTime> times;
};

// Walks a capture block by block: first to estimate normals, then as often as asked. A capture that is one block is
// read once and held; a larger one is read again.
class CaptureWalk {
public:
    using Visitor = std::function<void(const Observations&, const NormalBlock&)>;

    // Calibrates the lights and chooses photographs. All are referred to while the walk lives.
    CaptureWalk(const Capture& capture, const AcquireOptions& options, const Progress& progress,
                NormalEstimate& result);

    // Rough normals of each block, by a method that asks nothing of the object as a whole: for finding materials.
    void survey(const Visitor& visit);
    // Photographs -> normals: fills the result, and shows each block on the way. The method looks at each material by
    // itself. `materials` are referred to while the walk lives.
    void estimate(const Segmentation& materials, const Visitor& visit);
    // The blocks once more.
    void revisit(const std::function<void(const Observations&)>& visit);

private:
    void prepare(const Observations& first);
    void makeEstimators();
    void walk(const Visitor& visit);
    void walkFiles(const std::function<void(const Observations&)>& visit);
    void eachBlock(ObservationReader& reader, Observations& block, bool more,
                   const std::function<void(const Observations&)>& visit);
    NormalBlock normalsOf(const Observations& block);

    const AcquireOptions& options_;
    const Progress& progress_;
    NormalEstimate& result_;
    StageClock clock_;
    Capture given_;
    PreparedNormals prepared_; // its estimator is not used
    Observations sample_;
    const Segmentation* materials_ = nullptr; // null: none are known
    std::vector<NormalEstimator> estimators_; // one a material
    Observations whole_;                      // of a capture that is one block
};

// Photographs -> lights -> normals.
NormalEstimate estimateCaptureNormals(const Capture& capture, const AcquireOptions& options, const Progress& progress);

} // namespace nacre
