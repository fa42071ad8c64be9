#pragma once
#include <span>

#include <Eigen/Core>

#include "acquisition/residual/residual_estimate.h"
#include "acquisition/residual/residual_rows.h"
#include "engine/lights/light.h"

namespace nacre {

// Measures guesses of a sample's radiance as PSNR of radiance does: over `peak`, clipped to [0, 1].
class ResidualJudge {
public:
    ResidualJudge(const ResidualRows& rows, std::span<const Light> lights, float peak);

    // Squared errors, one a light. Guesses: radiance over irradiance, laid out as ResidualRows is.
    Eigen::ArrayXd errors(const Eigen::MatrixXf& guess) const;

private:
    Eigen::ArrayXXf shown(const Eigen::MatrixXf& rows) const;

    Eigen::ArrayXXf scales_; // [channel, light]: of radiance over irradiance to radiance over peak
    Eigen::ArrayXXf truth_;
};

// dB, the mean over the lights: one at the edge, whose errors are many times the others', does not speak for all.
double meanDecibels(const Eigen::ArrayXd& errors);

// PSNR in dB, the errors of all lights pooled.
double pooledDecibels(const Eigen::ArrayXd& errors);

// Every guess of a light is made from the others and by a BRDF that has not seen it. The BRDF is half trusted unless
// another share is better by half a decibel in the mean over the lights left out: few lights cannot tell more. The
// layer is kept where it pays by kResidualMargin, or where it is insisted on. `nodes`: directions of the lights.
ResidualFit chooseResidualFit(const ResidualRows& rows, const UnseenRows& unseen, std::span<const glm::vec3> nodes,
                              const ResidualJudge& judge, ResidualChoice choice);

// dB that errors of another kind, one a light, cost under lights left out.
double lossByErrors(const ResidualFit& fit, const Eigen::ArrayXd& errors);

// Orthonormal columns, most energetic first, that span the rows of X best in the least-squares sense: its right
// singular vectors, by subspace iteration (Halko, Martinsson, Tropp, Finding Structure with Randomness, 2011,
// algorithm 4.4). No mean is subtracted. The same for the same X; signs are such that each column's largest entry is
// positive.
Eigen::MatrixXf principalComponents(const Eigen::MatrixXf& rows, int most);

// The first principal components of the sample's residuals under the report's fit: as many as reach `toleranceDecibels`
// at the captured lights; where that is 0, as many as leave out an error that adds kComponentsLoss or less to the
// error under lights left out. At least one, at most `most`. Fills the report's components and capturedPsnr. The basis:
// orthonormal columns over [channel * lights + light].
Eigen::MatrixXf chooseComponents(const ResidualRows& rows, const ResidualJudge& judge, double toleranceDecibels,
                                 size_t most, ResidualReport& report);

inline constexpr double kComponentsLoss = 0.2; // dB, the mean over the lights

} // namespace nacre
