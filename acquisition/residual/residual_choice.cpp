#include "acquisition/residual/residual_choice.h"

#include <cmath>

#include <Eigen/Dense>

#include "acquisition/residual/light_spline.h"
#include "engine/lights/light_plane.h"

namespace nacre {
namespace {

constexpr double kPenalties[] = {1e-4, 1e-3, 1e-2, 1e-1};
constexpr float kTrusts[] = {0, 0.25f, 0.5f, 0.75f, 1};
constexpr double kUsualPenalty = 1e-2;
constexpr float kUsualTrust = 0.5f;
constexpr double kLevelQuantile = 2.807; // of the normal distribution at 5 % over the 20 settings compared

struct Candidate {
    bool hasLayer = true;
    float trust = 1;
    double penalty = 0;
    Eigen::ArrayXd errors; // squared, one a light
};

std::vector<Candidate> candidatesOf(const ResidualRows& rows, std::span<const Light> lights, const ResidualJudge& judge)
{
    std::vector<glm::vec2> nodes;
    for (const Light& light : lights) {
        nodes.push_back(lightPlanePoint(light.direction));
    }
    std::vector<Candidate> candidates = {{false, 1, 0, judge.errors(judge.unseen())}};
    for (const double penalty : kPenalties) {
        const Eigen::MatrixXf weights = leaveOneOutWeights(nodes, penalty).cast<float>().transpose();
        const Eigen::MatrixXf observed = rows.observed * weights, predicted = rows.predicted * weights;
        for (const float trust : kTrusts) {
            const Eigen::MatrixXf guess = observed + trust * (judge.unseen() - predicted);
            candidates.push_back({true, trust, penalty, judge.errors(guess)});
        }
    }
    return candidates;
}

// Student's t where the normal distribution has kLevelQuantile (Abramowitz and Stegun, Handbook of Mathematical
// Functions, 1964, 26.7.5).
double studentQuantile(double freedom)
{
    const double z = kLevelQuantile, z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
}

// By how much the mean error surely falls.
double certainGain(const Candidate& usual, const Candidate& other)
{
    const Eigen::ArrayXd gain = usual.errors - other.errors;
    const auto count = static_cast<double>(gain.size());
    const double freedom = std::max(count - 1, 1.0);
    const double variance = (gain - gain.mean()).square().sum() / freedom;
    return gain.mean() - studentQuantile(freedom) * std::sqrt(variance / count);
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

ResidualFit chooseResidualFit(const ResidualRows& rows, std::span<const Light> lights, const ResidualJudge& judge,
                              ResidualChoice choice)
{
    const std::vector<Candidate> candidates = candidatesOf(rows, lights, judge);
    const bool forced = choice == ResidualChoice::difference;
    const Candidate& best = bestOf(candidates, forced);
    const Candidate& layer = best.hasLayer ? best : bestOf(candidates, true);
    ResidualFit fit{.trust = layer.trust,
                    .penalty = layer.penalty,
                    .brdfPsnr = meanDecibels(candidates.front().errors),
                    .layerPsnr = meanDecibels(layer.errors),
                    .layerErrors = {layer.errors.begin(), layer.errors.end()}};
    fit.isKept = forced || (best.hasLayer && fit.layerPsnr > fit.brdfPsnr + kResidualMargin);
    return fit;
}

double lossByErrors(const ResidualFit& fit, const Eigen::ArrayXd& errors)
{
    const auto layer = Eigen::Map<const Eigen::ArrayXd>(fit.layerErrors.data(), errors.size());
    return meanDecibels(layer) - meanDecibels(layer + errors);
}

} // namespace nacre
