#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "acquisition/capture/observation_blocks.h"
#include "engine/surface/surface.h"

namespace nacre {

// automatic keeps the layer only where leaving photographs out says that it pays.
enum class ResidualChoice { automatic, none, difference };

struct ResidualOptions {
    ResidualChoice choice = ResidualChoice::none;
    double toleranceDecibels = 0; // as many components as reach this PSNR at the captured lights; 0: not asked
    size_t budgetBytes = 0;       // at most so many bytes; 0: not asked
    int threads = 0;
};

// How the residual between captured lights is guessed, judged by leaving each light out in turn.
struct ResidualFit {
    bool isKept = false;
    float trust = 1;                 // share of the BRDF's radiance that stays
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

struct EstimatedResidual {
    ResidualLayer layer; // empty where it is not kept
    ResidualReport report;
};

struct LeftOut; // left_out.h

// The layer of a finished surface, whose lights are the blocks', of which `leftOut` is a sample. Walks the blocks once.
// Throws Error (data) where a layer is insisted on and the lights are fewer than six or lie on a line.
EstimatedResidual estimateResidual(const Surface& surface, const ResidualOptions& options, const LeftOut& leftOut,
                                   ObservationBlocks& blocks);

} // namespace nacre
