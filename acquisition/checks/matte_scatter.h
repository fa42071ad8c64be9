#pragma once
#include <vector>

#include "acquisition/normals/normals.h"

namespace nacre {

// Which observations a comparison of models counts: those that a first fit lights, so that no later fit chooses what it
// is judged by.
struct MatteChoice {
    std::vector<char> counts; // [pixel * lights + light]
};

// Lit by the fit (n.l above a fifth of the pixel's bright level over its albedo) and not dark themselves.
MatteChoice matteObservations(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights);

// How far photographs are from Lambert's law where they follow it best: the mean of |log(observed / predicted)| over
// the smaller six tenths of the chosen observations, highlights and cast shadows being among the rest. A relative
// error: powers of the photographs multiply it by their exponent. 0 where nothing is chosen.
double matteScatter(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights,
                    const MatteChoice& choice);

} // namespace nacre
