#include "evaluation/held_out/irradiance_scale.h"

#include <cmath>

#include <Eigen/Dense>

#include "engine/files/measures.h"

namespace nacre {

namespace {

// A row 1, x, y for each light's direction.
Eigen::MatrixX3d affineTerms(const std::vector<Light>& lights)
{
    Eigen::MatrixX3d rows(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        rows.row(static_cast<Eigen::Index>(i)) << 1, lights[i].direction.x, lights[i].direction.y;
    }
    return rows;
}

} // namespace

void bringToScale(const std::vector<Light>& from, const std::vector<Light>& to, std::vector<Light>& lights)
{
    Eigen::MatrixX3d logs(from.size(), 3);
    for (size_t i = 0; i < from.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            logs(static_cast<Eigen::Index>(i), c) = std::log(double{to[i].irradiance[c]} / from[i].irradiance[c]);
        }
    }
    const Eigen::Matrix3d affine = affineTerms(from).completeOrthogonalDecomposition().solve(logs);
    const Eigen::MatrixX3d factors = (affineTerms(lights) * affine).array().exp();
    for (size_t i = 0; i < lights.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        lights[i].irradiance *= glm::vec3(factors(row, 0), factors(row, 1), factors(row, 2));
    }
}

void bringToMedianScale(const std::vector<Light>& from, const std::vector<Light>& to, std::vector<Light>& lights)
{
    for (int c = 0; c < 3; ++c) {
        std::vector<float> ratios;
        for (size_t i = 0; i < from.size(); ++i) {
            ratios.push_back(to[i].irradiance[c] / from[i].irradiance[c]);
        }
        const float factor = quantile(ratios, 0.5);
        for (Light& light : lights) {
            light.irradiance[c] *= factor;
        }
    }
}

} // namespace nacre
