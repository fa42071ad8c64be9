#include "evaluation/held_out/judging_photographs.h"

#include <algorithm>

#include "evaluation/held_out/held_out_measures.h"

namespace nacre {

std::vector<size_t> heldOutIndices(size_t photographs, const LightChoice& choice)
{
    std::vector<size_t> chosen;
    for (size_t i = 0; i < photographs; ++i) {
        if (isHeldOutOfEvery(i, choice.heldOutEvery, choice.heldOutFirst)) {
            chosen.push_back(i);
        }
    }
    return chosen;
}

JudgingPhotographs readJudging(const Capture& capture, const AcquireOptions& options, size_t every)
{
    const Rig rig = calibrateLights(capture, options.calibration);
    const std::vector<size_t> chosen = heldOutIndices(capture.photographs.size(), {.heldOutEvery = every});
    JudgingPhotographs judging;
    judging.lights = selectLights(rig.lights, chosen);
    const Capture heldOut = selectPhotographs(capture, chosen);
    ObservationReader(heldOut, options.normals.threads, ~size_t{0}).next(judging.seen);
    judging.peak = peakOf(judging.seen.radiance);
    return judging;
}

double psnrOf(const Surface& surface, const JudgingPhotographs& judging, int threads)
{
    return pooledPsnr(predictBySurface(surface, judging.seen, judging.lights, threads), judging.seen, judging.peak);
}

} // namespace nacre
