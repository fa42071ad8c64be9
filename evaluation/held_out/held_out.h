#pragma once
#include <string>
#include <vector>

#include "acquisition/chain/acquire.h"
#include "evaluation/held_out/held_out_measures.h"
#include "evaluation/held_out/relighting_baselines.h"

namespace nacre {

// How well one method predicts photographs that it has not seen.
struct PredictionScore {
    std::string method;     // "nacre", or a baseline with the smoothing that served it best
    double psnr = 0;        // dB of radiance, colour, errors pooled over the photographs: radiancePsnr
    double greyPsnr = 0;    // the same of grey pictures
    double ownPeakPsnr = 0; // of grey pictures, each divided by its own 99th percentile: less of a highlight counts
    std::vector<double> photographs; // dB of colour, one each
};

struct HeldOutEvaluation {
    std::vector<std::string> photographs;     // names of those held out
    size_t given = 0;                         // how many the methods have seen
    std::vector<PredictionScore> scores;      // nacre first
    std::vector<PhotographMeasures> measures; // of nacre's prediction, one a photograph held out
    size_t worst = 0;                         // of them, by PSNR: these pictures
    Image worstPhotograph, worstPrediction;   // linear radiance, 0 beside the object
    double peak = 1;                          // 99th percentile of the capture's mask
    size_t modelBytes = 0;
    double seconds = 0;      // of the acquisition
    Acquisition acquisition; // from the photographs given
};

// Acquires from the photographs that options.lights gives (its heldOutEvery must be positive) and predicts those held
// out, with the irradiances that the whole capture gives them: calibrated, reconciled with each other where
// options.correctIntensities says so, on the scale of those that the acquisition found. Baselines see the same
// photographs with the irradiances found; each is judged at the smoothing that turns out best for it, which nobody
// would know beforehand. Radiance is divided by the 99th
// percentile of all the mask's values and clipped to [0, 1]. Reads the whole capture at once.
// With several rounds, the photographs held out move on by one each round, errors are pooled over all rounds and the
// last one's acquisition is answered: as many as options.lights.heldOutEvery leave each photograph out once.
HeldOutEvaluation evaluateHeldOut(const Capture& capture, AcquireOptions options,
                                  const std::vector<RelightingBaseline>& baselines, const Progress& progress,
                                  size_t rounds = 1);

} // namespace nacre
