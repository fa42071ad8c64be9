#pragma once
#include <string>
#include <vector>

#include "acquisition/residual/residual_options.h"

namespace nacre {

// How the residual between captured lights is guessed, judged by leaving each light out in turn.
struct ResidualFit {
    bool isKept = false;
    float trust = 1;                 // share of the BRDF's radiance that stays
    double penalty = 0;              // of the spline
    double brdfPsnr = 0;             // dB of radiance under the lights left out, their mean, by the BRDF alone
    double layerPsnr = 0;            // and with the layer
    std::vector<double> layerErrors; // squared, of peak 1: one a light
};

// The margin by which a layer has to predict lights left out better than the BRDF alone.
inline constexpr double kResidualMargin = 0.3; // dB

struct ResidualReport {
    ResidualChoice choice = ResidualChoice::none;
    ResidualFit fit{};       // judged where whyNot is empty and the choice is not none
    std::string whyNot;      // where lights cannot tell, or the budget holds nothing
    int components = 0;      // kept; 0: no layer
    double capturedPsnr = 0; // dB of radiance at the captured lights, by the components kept
    size_t bytes = 0;        // of the layer, pixels of the mask alone
};

} // namespace nacre
