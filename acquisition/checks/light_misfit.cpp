#include "acquisition/checks/light_misfit.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <glm/trigonometric.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

// What a linear function of l takes up per light; with no more photographs everything is.
constexpr size_t kFewestMisfitLights = 6;

Eigen::Vector3d eigenOf(const glm::vec3& v)
{
    return {v.x, v.y, v.z};
}

// l' - l of one photograph.
Eigen::Vector3d misfitOf(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights,
                         size_t light)
{
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    const Eigen::Vector3d l = eigenOf(lights[light].direction);
    for (size_t p = 0; p < fit.pixels.size(); ++p) {
        if (fit.pixels[p].albedo > 0 && fit.verdicts[p * lights.size() + light] == Verdict::used) {
            const Eigen::Vector3d n = eigenOf(fit.pixels[p].normal);
            products += n * n.transpose();
            right += n * (intensities.ofPixel(p)[light] / fit.pixels[p].albedo - n.dot(l));
        }
    }
    return products.completeOrthogonalDecomposition().solve(right);
}

} // namespace

double lightMisfitDegrees(const Intensities& intensities, const NormalBlock& fit, const std::vector<Light>& lights)
{
    const auto n = static_cast<Eigen::Index>(lights.size());
    if (lights.size() < kFewestMisfitLights) {
        return 0;
    }
    Eigen::MatrixXd directions(n, 3), misfits(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        directions.row(i) = eigenOf(lights[static_cast<size_t>(i)].direction).transpose();
        misfits.row(i) = misfitOf(intensities, fit, lights, static_cast<size_t>(i)).transpose();
    }
    misfits -= directions * directions.colPivHouseholderQr().solve(misfits);
    std::vector<float> angles;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Vector3d l = directions.row(i).transpose(), d = misfits.row(i).transpose();
        angles.push_back(static_cast<float>((d - l * l.dot(d)).norm()));
    }
    const double freedom = std::sqrt(static_cast<double>(n) / static_cast<double>(n - 3));
    return glm::degrees(freedom * quantile(angles, 0.5));
}

} // namespace nacre
