#pragma once
#include <span>

#include "acquisition/residual/residual_judge.h"
#include "acquisition/residual/residual_report.h"

namespace nacre {

// A half-trusted BRDF with moderate smoothing is what is taken unless another setting is better, in the mean over the
// lights left out, at a level of 5 % shared by all settings (Student's t; Dunn, Multiple Comparisons among Means,
// 1961): few lights cannot tell settings apart. In either case the layer is kept where it pays by kResidualMargin.
ResidualFit chooseResidualFit(const ResidualRows& rows, std::span<const Light> lights, const ResidualJudge& judge,
                              ResidualChoice choice);

// dB that errors of another kind, one a light, cost under lights left out.
double lossByErrors(const ResidualFit& fit, const Eigen::ArrayXd& errors);

} // namespace nacre
