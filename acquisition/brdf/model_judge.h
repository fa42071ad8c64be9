#pragma once
#include <vector>

#include "acquisition/brdf/interpolation.h"
#include "acquisition/brdf/lobe_fit.h"
#include "engine/brdf/compact_brdf.h"

namespace nacre {

// Says how well a smaller model stands for a material: radiance of a reference ball under lights over the range that
// the material's table spans, where it is covered; divided by its 99th percentile and clipped to [0, 1].
class ModelJudge {
public:
    struct Verdict {
        double psnr = 0;        // dB of radiance against the interpolant
        double nanoseconds = 0; // of one evaluation on one core, of its own time
    };

    // `full`: the table baked from the interpolant; it must live longer.
    ModelJudge(const BrdfInterpolant& interpolant, const BrdfTable& full, int threads);

    bool isEmpty() const { return judges_.empty(); } // nothing is covered
    const BrdfTable& table() const { return *full_; }

    Verdict judge(const CompactBrdf& model) const;

    // A part of what is judged, for fits; what is clipped is weighed down, since it does not show.
    std::vector<BrdfMeasurement> fittedPart() const;

private:
    std::vector<BrdfMeasurement> judges_; // weight: n.l
    double peak_ = 1;                     // f n.l that shows as 1
    const BrdfTable* full_;
};

} // namespace nacre
