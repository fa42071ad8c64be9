#pragma once
#include <optional>
#include <vector>

#include "acquisition/exemplar/ball_match.h"

namespace nacre {

struct LightSplit {
    std::vector<size_t> kept, heldOut; // indices of lights
    std::vector<Light> keptLights, heldOutLights;
};

// The worst condition (lights.h) of lights that span space well enough to match exemplars.
inline constexpr double kWorstSpan = 30;

// Every sixth light is held out; none where they are too few, or where those that are left lie too nearly in a plane.
std::optional<LightSplit> splitLights(const std::vector<Light>& lights);

// The object's sample under the lights that are kept, and what the others showed of it.
struct Jury {
    LightSplit split;
    PixelLattice kept;
    BallGrid grid;
    Intensities heldOut; // rows as in the sample
    BallGrid heldOutGrid;
};

Jury makeJury(const Intensities& sample, const LightSplit& split, int threads);

// Per pixel of the lattice, whose rows are the sample's: the mean error of what its match predicts of the lights that
// were held out, |sqrt(observed) - sqrt(predicted)| over the root of the pixel's bright level, truncated, in units of
// the truncation: [0,1].
std::vector<float> heldOutErrors(const Jury& jury, MatchModel model, const PixelLattice& lattice,
                                 const std::vector<BallMatch>& matches, int threads);

// Of normals alone, one for each pixel of jury.kept: the reflectance that follows from them, of both forms that it may
// have the better one.
std::vector<float> heldOutErrors(const Jury& jury, const std::vector<glm::vec3>& normals, int threads);

double meanOf(const std::vector<float>& values);

} // namespace nacre
