#include "acquisition/residual/residual_choice.h"

#include <cmath>

#include <Eigen/Dense>

#include "acquisition/residual/light_spline.h"
#include "engine/scene/light_plane.h"

namespace nacre {
namespace {

constexpr double kPenalties[] = {1e-4, 1e-3, 1e-2, 1e-1};
constexpr float kTrusts[] = {0, 0.25f, 0.5f, 0.75f, 1};
constexpr double kUsualPenalty = 1e-2;
constexpr float kUsualTrust = 0.5f;
constexpr double kStandardErrors = 2;
constexpr double kMostLeverage = 0.9; // a light that alone decides normals says little, but not nothing

struct Candidate {
    bool hasLayer = true;
    float trust = 1;
    double penalty = 0;
    Eigen::ArrayXd errors; // squared, one a light
};

// Multiplied by it, radiance over irradiance becomes radiance over peak: [channel, light].
Eigen::ArrayXXf scalesOf(std::span<const Light> lights, float peak)
{
    Eigen::ArrayXXf scales(3, lights.size());
    for (size_t i = 0; i < lights.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            scales(c, static_cast<Eigen::Index>(i)) = lights[i].irradiance[c] / peak;
        }
    }
    return scales;
}

Eigen::ArrayXXf clipped(const Eigen::MatrixXf& rows, const Eigen::ArrayXXf& scales)
{
    Eigen::ArrayXXf values = rows.array();
    for (Eigen::Index row = 0; row < values.rows(); ++row) {
        values.row(row) *= scales.row(row % 3);
    }
    return values.max(0.0f).min(1.0f);
}

Eigen::ArrayXd errorsPerLight(const Eigen::ArrayXXf& truth, const Eigen::MatrixXf& guess, const Eigen::ArrayXXf& scales)
{
    return (clipped(guess, scales) - truth).cast<double>().square().colwise().mean().transpose();
}

// Share of each light's observation in its own Lambertian fit: the diagonal of L (L'L)^-1 L'.
Eigen::ArrayXf leverages(std::span<const Light> lights)
{
    Eigen::MatrixXd matrix(lights.size(), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3& l = lights[i].direction;
        matrix.row(static_cast<Eigen::Index>(i)) << l.x, l.y, l.z;
    }
    const Eigen::MatrixXd hat = matrix * (matrix.transpose() * matrix).ldlt().solve(matrix.transpose());
    return hat.diagonal().array().max(0.0).min(kMostLeverage).cast<float>();
}

// What the BRDF would have said of each light without having seen it, to first order.
Eigen::MatrixXf predictedUnseen(const ResidualRows& rows, std::span<const Light> lights)
{
    const Eigen::ArrayXf kept = 1 - leverages(lights);
    const Eigen::MatrixXf errors = rows.observed - rows.predicted;
    return rows.observed - errors * kept.inverse().matrix().asDiagonal();
}

std::vector<Candidate> candidatesOf(const ResidualRows& rows, std::span<const Light> lights, float peak)
{
    std::vector<glm::vec2> nodes;
    for (const Light& light : lights) {
        nodes.push_back(lightPlanePoint(light.direction));
    }
    const Eigen::ArrayXXf scales = scalesOf(lights, peak), truth = clipped(rows.observed, scales);
    const Eigen::MatrixXf unseen = predictedUnseen(rows, lights);
    std::vector<Candidate> candidates = {{false, 1, 0, errorsPerLight(truth, unseen, scales)}};
    for (const double penalty : kPenalties) {
        const Eigen::MatrixXf weights = leaveOneOutWeights(nodes, penalty).cast<float>().transpose();
        const Eigen::MatrixXf observed = rows.observed * weights, predicted = rows.predicted * weights;
        for (const float trust : kTrusts) {
            const Eigen::MatrixXf guess = trust * unseen + observed - trust * predicted;
            candidates.push_back({true, trust, penalty, errorsPerLight(truth, guess, scales)});
        }
    }
    return candidates;
}

// By how much the mean error falls, less two of its standard errors.
double certainGain(const Candidate& usual, const Candidate& other)
{
    const Eigen::ArrayXd gain = usual.errors - other.errors;
    const auto count = static_cast<double>(gain.size());
    const double variance = (gain - gain.mean()).square().sum() / std::max(count - 1, 1.0);
    return gain.mean() - kStandardErrors * std::sqrt(variance / count);
}

double decibelsOf(const Candidate& candidate)
{
    return -10 * std::log10(std::max(candidate.errors.mean(), 1e-12));
}

const Candidate& bestOf(const std::vector<Candidate>& candidates, bool layersAlone)
{
    const auto isUsual = [](const Candidate& c) { return c.penalty == kUsualPenalty && c.trust == kUsualTrust; };
    const Candidate& usual = *std::find_if(candidates.begin(), candidates.end(), isUsual);
    const Candidate* best = &usual;
    for (const Candidate& candidate : candidates) {
        const bool allowed = candidate.hasLayer || !layersAlone;
        if (allowed && certainGain(usual, candidate) > 0 && candidate.errors.mean() < best->errors.mean()) {
            best = &candidate;
        }
    }
    return *best;
}

} // namespace

ResidualFit chooseResidualFit(const ResidualRows& rows, std::span<const Light> lights, float peak,
                              ResidualChoice choice)
{
    const std::vector<Candidate> candidates = candidatesOf(rows, lights, peak);
    const bool forced = choice == ResidualChoice::difference;
    const Candidate& best = bestOf(candidates, forced);
    const Candidate& layer = best.hasLayer ? best : bestOf(candidates, true);
    ResidualFit fit{.trust = layer.trust,
                    .penalty = layer.penalty,
                    .brdfPsnr = decibelsOf(candidates.front()),
                    .layerPsnr = decibelsOf(layer),
                    .layerError = layer.errors.mean()};
    fit.isKept = forced || (best.hasLayer && fit.layerPsnr > fit.brdfPsnr + kResidualMargin);
    return fit;
}

} // namespace nacre
