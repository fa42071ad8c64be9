#pragma once
#include "acquisition/checks/facing_ratios.h"

namespace nacre {

// How the median ratios answer to small logarithmic errors x of the irradiances: log ratios = M x. Each pixel's normal
// takes up what of x is linear in its lights, so M is the mean over the pixels of I - P, P the projector onto their
// directions, weighted by squared cosines.
Eigen::MatrixXd responseOf(const NormalBlock& normals, const std::vector<Light>& lights);

// Newton's step of the log ratios x to where the medians equal prior * x, which they miss. It is held back while they
// are large, as M holds for small ones alone.
Eigen::VectorXd newtonStep(const MedianRatios& medians, const Eigen::VectorXd& missed, const Eigen::MatrixXd& all,
                           double prior, bool fixesScale);

} // namespace nacre
