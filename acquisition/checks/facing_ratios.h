#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "acquisition/capture/observations.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// Fewer pixels tell nothing of a photograph.
constexpr size_t kFewestRatioPixels = 20;
// A photograph is dark where less than this share of what faces its light is lit: cast shadows leave more.
constexpr float kLeastLitShare = 0.1f;

// How far a photograph's pixels are from agreeing on one ratio.
struct PhotographScatter {
    float spread = 0;   // robust standard deviation of observation over prediction, relative to its median
    float litShare = 0; // of the pixels that face the light
};

// Observation over prediction per channel: the prediction is the pixel's own albedo in the channel times n.l.
struct ChannelRatios {
    std::vector<float> values[3];
    std::vector<float> grey;

    void add(const glm::vec3& ratio, float greyRatio)
    {
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(ratio[c])) {
                values[c].push_back(ratio[c]);
            }
        }
        if (std::isfinite(greyRatio)) {
            grey.push_back(greyRatio);
        }
    }
};

// Of the pixels that face one photograph's light.
struct FacingRatios {
    ChannelRatios lit, shadowed;

    float litShare() const
    {
        return static_cast<float>(lit.grey.size()) / std::max<size_t>(1, lit.grey.size() + shadowed.grey.size());
    }
    // A photograph that is dark nearly everywhere may be merely dim: its dark pixels then agree on a ratio.
    ChannelRatios& telling() { return litShare() < kLeastLitShare ? shadowed : lit; }
};

// Of every photograph, by normals and verdicts of its pixels.
std::vector<FacingRatios> gatherRatios(const Observations& sample, const NormalBlock& normals,
                                       const std::vector<Light>& lights, int threads);

// Ratios are reordered.
std::vector<PhotographScatter> scattersOf(std::vector<FacingRatios>& gathered, int threads);

// Of the free photographs that show enough: median ratios, logarithms of grey and the colour beside it.
struct MedianRatios {
    std::vector<Eigen::Index> photographs;
    Eigen::VectorXd logs;
    std::vector<glm::vec3> colours;
};

MedianRatios mediansOf(std::vector<FacingRatios>& gathered, const std::vector<bool>& isFree, int threads);

} // namespace nacre
