#pragma once
#include "acquisition/residual/residual_choice.h"

namespace nacre {

// The first principal components of the sample's residuals under the report's fit: as many as reach `toleranceDecibels`
// at the captured lights; where that is 0, as many as leave out an error that adds kComponentsLoss or less to the
// error under lights left out. At least one, at most `most`. Fills the report's components and capturedPsnr. The basis:
// orthonormal columns over [channel * lights + light].
Eigen::MatrixXf chooseComponents(const ResidualRows& rows, const ResidualJudge& judge, double toleranceDecibels,
                                 size_t most, ResidualReport& report);

inline constexpr double kComponentsLoss = 0.2; // dB, the mean over the lights

} // namespace nacre
