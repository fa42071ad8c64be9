#include "acquisition/residual/residual_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Dense>

#include "acquisition/residual/light_spline.h"
#include "engine/files/hash_random.h"
#include "engine/lights/light_plane.h"

namespace nacre {

namespace {

constexpr double kLeastError = 1e-12;

} // namespace

ResidualJudge::ResidualJudge(const ResidualRows& rows, std::span<const Light> lights, float peak)
    : scales_(3, lights.size())
{
    for (size_t i = 0; i < lights.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            scales_(c, static_cast<Eigen::Index>(i)) = lights[i].irradiance[c] / peak;
        }
    }
    truth_ = shown(rows.observed);
}

Eigen::ArrayXXf ResidualJudge::shown(const Eigen::MatrixXf& rows) const
{
    Eigen::ArrayXXf values = rows.array();
    for (Eigen::Index light = 0; light < values.cols(); ++light) {
        for (Eigen::Index row = 0; row < values.rows(); ++row) {
            values(row, light) *= scales_(row % 3, light);
        }
    }
    return values.max(0.0f).min(1.0f);
}

Eigen::ArrayXd ResidualJudge::errors(const Eigen::MatrixXf& guess) const
{
    return (shown(guess) - truth_).square().colwise().mean().cast<double>().transpose();
}

double meanDecibels(const Eigen::ArrayXd& errors)
{
    return -10 * errors.max(kLeastError).log10().mean();
}

double pooledDecibels(const Eigen::ArrayXd& errors)
{
    return -10 * std::log10(std::max(errors.mean(), kLeastError));
}

namespace {

constexpr double kPenalties[] = {1e-4, 1e-3, 1e-2, 1e-1};
constexpr float kTrusts[] = {0, 0.25f, 0.5f, 0.75f, 1};
constexpr double kUsualPenalty = 1e-2;
constexpr float kUsualTrust = 0.5f;
constexpr double kLevelQuantile = 2.807; // of the normal distribution at 5 % over the 20 settings compared
constexpr double kOneStandardError = 1;

struct ResidualCandidate {
    bool hasLayer = true;
    float trust = 1;
    double penalty = 0;
    Eigen::ArrayXd errors; // squared, one a light
};

// What is left of each light's prediction where the other lights' predictions, so weighed, are taken from it: all by
// the fold that has not seen the light. Without weights the prediction itself.
Eigen::MatrixXf unseenBeyond(const UnseenRows& unseen, const Eigen::MatrixXf& weights)
{
    Eigen::MatrixXf left(unseen.predicted.front().rows(), weights.cols());
    for (size_t fold = 0; fold < unseen.folds.size(); ++fold) {
        const Eigen::MatrixXf& predicted = unseen.predicted[fold];
        for (const size_t light : unseen.folds[fold]) {
            const auto column = static_cast<Eigen::Index>(light);
            left.col(column) = predicted.col(column) - predicted * weights.col(column);
        }
    }
    return left;
}

std::vector<ResidualCandidate> candidatesOf(const ResidualRows& rows, const UnseenRows& unseen,
                                            std::span<const Light> lights, const ResidualJudge& judge)
{
    std::vector<glm::vec2> nodes;
    for (const Light& light : lights) {
        nodes.push_back(lightPlanePoint(light.direction));
    }
    const auto count = static_cast<Eigen::Index>(nodes.size());
    const Eigen::MatrixXf byBrdf = unseenBeyond(unseen, Eigen::MatrixXf::Zero(count, count));
    std::vector<ResidualCandidate> candidates = {{false, 1, 0, judge.errors(byBrdf)}};
    for (const double penalty : kPenalties) {
        const Eigen::MatrixXf weights = leaveOneOutWeights(nodes, penalty).cast<float>().transpose();
        const Eigen::MatrixXf observed = rows.observed * weights, beyond = unseenBeyond(unseen, weights);
        for (const float trust : kTrusts) {
            candidates.push_back({true, trust, penalty, judge.errors(observed + trust * beyond)});
        }
    }
    return candidates;
}

// Student's t where the normal distribution has z (Abramowitz and Stegun, Handbook of Mathematical
// Functions, 1964, 26.7.5).
double studentQuantile(double z, double freedom)
{
    const double z3 = z * z * z, z5 = z3 * z * z;
    return z + (z3 + z) / (4 * freedom) + (5 * z5 + 16 * z3 + 3 * z) / (96 * freedom * freedom);
}

// By how much the mean gain, one a light, surely exceeds 0 so many standard errors away.
double certainGain(const Eigen::ArrayXd& gain, double quantileOfNormal)
{
    const auto count = static_cast<double>(gain.size());
    const double freedom = std::max(count - 1, 1.0);
    const double variance = (gain - gain.mean()).square().sum() / freedom;
    return gain.mean() - studentQuantile(quantileOfNormal, freedom) * std::sqrt(variance / count);
}

// A light that is left out is further from the others than those that will be asked for between them. That makes
// splines look worse than they will be, and says nothing against the BRDF: who trusts them more needs less evidence.
bool isSurelyBetter(const ResidualCandidate& other, const ResidualCandidate& usual)
{
    if (other.hasLayer && other.trust < usual.trust) {
        const Eigen::ArrayXd gain = usual.errors.max(kLeastError).log10() - other.errors.max(kLeastError).log10();
        return certainGain(gain, kOneStandardError) > 0;
    }
    return certainGain(usual.errors - other.errors, kLevelQuantile) > 0;
}

const ResidualCandidate& bestOf(const std::vector<ResidualCandidate>& candidates, bool layersAlone)
{
    const auto isUsual = [](const ResidualCandidate& c) {
        return c.penalty == kUsualPenalty && c.trust == kUsualTrust;
    };
    const ResidualCandidate& usual = *std::find_if(candidates.begin(), candidates.end(), isUsual);
    const ResidualCandidate* best = &usual;
    for (const ResidualCandidate& candidate : candidates) {
        const bool allowed = candidate.hasLayer || !layersAlone;
        if (allowed && isSurelyBetter(candidate, usual) && candidate.errors.mean() < best->errors.mean()) {
            best = &candidate;
        }
    }
    return *best;
}

} // namespace

ResidualFit chooseResidualFit(const ResidualRows& rows, const UnseenRows& unseen, std::span<const Light> lights,
                              const ResidualJudge& judge, ResidualChoice choice)
{
    const std::vector<ResidualCandidate> candidates = candidatesOf(rows, unseen, lights, judge);
    const bool forced = choice == ResidualChoice::difference;
    const ResidualCandidate& best = bestOf(candidates, forced);
    const ResidualCandidate& layer = best.hasLayer ? best : bestOf(candidates, true);
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

namespace {

constexpr int kIterations = 6;

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns)
{
    const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
    return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

} // namespace

Eigen::MatrixXf principalComponents(const Eigen::MatrixXf& rows, int most)
{
    const Eigen::Index count = std::min({Eigen::Index{most}, rows.rows(), rows.cols()});
    Eigen::MatrixXf basis(rows.cols(), count);
    uint64_t random = 0;
    for (Eigen::Index i = 0; i < basis.size(); ++i) { // in [-1, 1)
        basis(i) = static_cast<float>(static_cast<double>(nextRandom(random) >> 11) * 0x1p-52 - 1);
    }
    for (int i = 0; i < kIterations; ++i) {
        basis = orthonormal(rows.transpose() * (rows * basis));
    }
    const Eigen::MatrixXf projected = rows * basis;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> energies(projected.transpose() * projected);
    basis = basis * energies.eigenvectors().rowwise().reverse();
    for (Eigen::Index k = 0; k < count; ++k) {
        Eigen::Index largest = 0;
        basis.col(k).cwiseAbs().maxCoeff(&largest);
        basis.col(k) *= basis(largest, k) < 0 ? -1.0f : 1.0f;
    }
    return basis;
}

namespace {

// Adds amounts [pixel] of a component to guesses laid out as ResidualRows is.
void addComponent(const Eigen::VectorXf& amounts, const Eigen::VectorXf& component, Eigen::MatrixXf& guess)
{
    const Eigen::Index lights = guess.cols();
    for (Eigen::Index light = 0; light < lights; ++light) {
        for (Eigen::Index pixel = 0; pixel < amounts.size(); ++pixel) {
            for (Eigen::Index c = 0; c < 3; ++c) {
                guess(3 * pixel + c, light) += amounts(pixel) * component(c * lights + light);
            }
        }
    }
}

} // namespace

Eigen::MatrixXf chooseComponents(const ResidualRows& rows, const ResidualJudge& judge, double toleranceDecibels,
                                 size_t most, ResidualReport& report)
{
    const Eigen::MatrixXf residuals = residualsOf(rows, report.fit.trust);
    const Eigen::MatrixXf basis = principalComponents(residuals, static_cast<int>(most));
    const Eigen::MatrixXf amounts = residuals * basis;
    Eigen::MatrixXf captured = report.fit.trust * rows.predicted;
    Eigen::ArrayXd errors = judge.errors(captured);
    const auto isEnough = [&] {
        return toleranceDecibels > 0 ? pooledDecibels(errors) >= toleranceDecibels
                                     : lossByErrors(report.fit, errors) <= kComponentsLoss;
    };
    Eigen::Index count = 0;
    while (count < basis.cols() && (count == 0 || !isEnough())) {
        addComponent(amounts.col(count), basis.col(count), captured);
        errors = judge.errors(captured);
        ++count;
    }
    report.components = static_cast<int>(count);
    report.capturedPsnr = pooledDecibels(errors);
    return basis.leftCols(count);
}

} // namespace nacre
