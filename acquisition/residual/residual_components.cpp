#include "acquisition/residual/residual_components.h"

#include "acquisition/residual/principal_components.h"

namespace nacre {
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
