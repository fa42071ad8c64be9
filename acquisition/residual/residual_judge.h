#pragma once
#include <span>

#include <Eigen/Core>

#include "acquisition/residual/residual_rows.h"
#include "engine/lights/light.h"

namespace nacre {

// Measures guesses of a sample's radiance as PSNR of radiance does: over `peak`, clipped to [0, 1].
class ResidualJudge {
public:
    ResidualJudge(const ResidualRows& rows, std::span<const Light> lights, float peak);

    // Squared errors, one a light. Guesses: radiance over irradiance, laid out as ResidualRows is.
    Eigen::ArrayXd errors(const Eigen::MatrixXf& guess) const;

    // What the BRDF would have said of each light without having seen it, to first order: its errors raised by their
    // leverage on Lambertian normals (Allen, The Relationship between Variable Selection and Data Augmentation, 1974).
    const Eigen::MatrixXf& unseen() const { return unseen_; }

private:
    Eigen::ArrayXXf shown(const Eigen::MatrixXf& rows) const;

    Eigen::ArrayXXf scales_; // [channel, light]: of radiance over irradiance to radiance over peak
    Eigen::ArrayXXf truth_;
    Eigen::MatrixXf unseen_;
};

// dB, the mean over the lights: one at the edge, whose errors are many times the others', does not speak for all.
double meanDecibels(const Eigen::ArrayXd& errors);

// PSNR in dB, the errors of all lights pooled.
double pooledDecibels(const Eigen::ArrayXd& errors);

} // namespace nacre
