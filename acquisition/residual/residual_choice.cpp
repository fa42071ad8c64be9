#include "acquisition/residual/residual_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Dense>

#include "acquisition/residual/light_interpolation.h"
#include "engine/files/hash_random.h"

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

constexpr float kTrusts[] = {0, 0.25f, 0.5f, 0.75f, 1};
constexpr float kUsualTrust = 0.5f;
constexpr double kTrustMargin = 0.5; // dB

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

struct ResidualCandidate {
    float trust = 1;
    Eigen::ArrayXd errors; // squared, one a light
    double psnr = 0;       // dB, their mean
};

const ResidualCandidate& bestOf(const std::vector<ResidualCandidate>& candidates)
{
    const auto less = [](const ResidualCandidate& a, const ResidualCandidate& b) {
        return a.psnr + (a.trust == kUsualTrust ? kTrustMargin : 0) <
               b.psnr + (b.trust == kUsualTrust ? kTrustMargin : 0);
    };
    return *std::max_element(candidates.begin(), candidates.end(), less);
}

} // namespace

ResidualFit chooseResidualFit(const ResidualRows& rows, const UnseenRows& unseen, std::span<const glm::vec3> nodes,
                              const ResidualJudge& judge, ResidualChoice choice)
{
    const Eigen::MatrixXf weights = leaveOneOutWeights(nodes).cast<float>().transpose();
    const Eigen::MatrixXf byOthers = rows.observed * weights, beyond = unseenBeyond(unseen, weights);
    std::vector<ResidualCandidate> layers;
    for (const float trust : kTrusts) {
        const Eigen::ArrayXd errors = judge.errors(byOthers + trust * beyond);
        layers.push_back({trust, errors, meanDecibels(errors)});
    }
    const ResidualCandidate& layer = bestOf(layers);
    const Eigen::MatrixXf byBrdf = unseenBeyond(unseen, Eigen::MatrixXf::Zero(weights.rows(), weights.cols()));
    ResidualFit fit{.trust = layer.trust,
                    .brdfPsnr = meanDecibels(judge.errors(byBrdf)),
                    .layerPsnr = layer.psnr,
                    .layerErrors = {layer.errors.begin(), layer.errors.end()}};
    fit.isKept = choice == ResidualChoice::difference || fit.layerPsnr > fit.brdfPsnr + kResidualMargin;
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
