#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/brdf/interpolation.h"
#include "engine/brdf/brdf_models.h"
#include "engine/brdf/compact_brdf.h"

namespace nacre {

// A configuration and what is measured there.
struct BrdfMeasurement {
    glm::vec3 n, l, v;
    glm::vec3 f;      // 1/sr
    float weight = 1; // of the error in f: how it shows, e.g. n.l
};

// The diffuse part that fits best; A = 0.
AbcModel fitLambert(const std::vector<BrdfMeasurement>& measurements);

// Diffuse part and one ABC lobe (Loew et al. 2012): kD and A by non-negative least squares per channel, B and C by a
// search over a grid, refined. The index of refraction is fixed: thetaD alone does not determine it where lights are in
// front.
AbcModel fitLobe(const std::vector<BrdfMeasurement>& measurements);

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
    // dB of radiance of any f; asked for n, l and v of measurements (f is the interpolant's).
    double psnrOf(const std::function<glm::vec3(const BrdfMeasurement&)>& f) const;

    // A part of what is judged, for fits; what is clipped is weighed down, since it does not show.
    std::vector<BrdfMeasurement> fittedPart() const;

private:
    std::vector<BrdfMeasurement> judges_; // weight: n.l
    double peak_ = 1;                     // f n.l that shows as 1
    const BrdfTable* full_;
};

// What a model has to be good enough for. One of the two is asked for.
struct LadderOptions {
    double toleranceDecibels = 0; // the smallest model with at least this PSNR; 0: not asked
    size_t budgetBytes = 0;       // the best model of at most so many bytes; 0: not asked
    int threads = 0;

    bool isAsked() const { return toleranceDecibels > 0 || budgetBytes > 0; }
};

struct LadderStep {
    CompactBrdf model;
    std::string description; // e.g. "table 64x12x12 RGBA16F"
    size_t bytes = 0;        // coverage apart
    double psnr = 0;         // dB of radiance against the interpolant
    double nanoseconds = 0;  // of one evaluation on one core, of its own time
};

struct ModelLadder {
    std::vector<LadderStep> steps; // by bytes
    std::optional<size_t> taken;   // empty where none meets the bound: the full table stays
};

// The models from Lambert to the full table, each judged.
ModelLadder climbLadder(const ModelJudge& judge, const LadderOptions& options);

} // namespace nacre
