#include "acquisition/residual/residual_rows.h"

#include <algorithm>

namespace nacre {

ResidualRows residualRows(const Observations& block, std::span<const size_t> places, const Surface& surface,
                          const LightBalls& balls)
{
    ResidualRows rows;
    for (const size_t place : places) {
        rows.pixels.push_back(block.pixels[place]);
    }
    rows.predicted = predictedRows(balls, rows.pixels, block.lightCount);
    rows.observed.resizeLike(rows.predicted);
    for (size_t p = 0; p < places.size(); ++p) {
        for (size_t i = 0; i < block.lightCount; ++i) {
            const glm::vec3 observed = block.radianceOf(places[p])[i] / surface.lights[i].light.irradiance;
            const bool clipped = block.saturatedOf(places[p])[i] != 0;
            for (int c = 0; c < 3; ++c) {
                const auto row = static_cast<Eigen::Index>(3 * p + c), column = static_cast<Eigen::Index>(i);
                rows.observed(row, column) = clipped ? std::max(observed[c], rows.predicted(row, column)) : observed[c];
            }
        }
    }
    return rows;
}

Eigen::MatrixXf predictedRows(const LightBalls& balls, std::span<const uint32_t> pixels, size_t lights)
{
    const auto columns = static_cast<Eigen::Index>(lights);
    Eigen::MatrixXf predicted(static_cast<Eigen::Index>(3 * pixels.size()), columns);
    std::vector<float> values(3 * lights);
    for (size_t p = 0; p < pixels.size(); ++p) {
        balls.predict(pixels[p], values);
        for (size_t c = 0; c < 3; ++c) {
            predicted.row(static_cast<Eigen::Index>(3 * p + c)) =
                Eigen::Map<const Eigen::RowVectorXf>(&values[c * lights], columns);
        }
    }
    return predicted;
}

Eigen::MatrixXf residualsOf(const ResidualRows& rows, float trust)
{
    const Eigen::MatrixXf left = rows.observed - trust * rows.predicted;
    const Eigen::Index lights = left.cols();
    Eigen::MatrixXf joined(left.rows() / 3, 3 * lights);
    for (Eigen::Index pixel = 0; pixel < joined.rows(); ++pixel) {
        for (Eigen::Index c = 0; c < 3; ++c) {
            joined.block(pixel, c * lights, 1, lights) = left.row(3 * pixel + c);
        }
    }
    return joined;
}

std::vector<size_t> shadedPlaces(const Observations& block, const Surface& surface)
{
    std::vector<size_t> places;
    for (size_t i = 0; i < block.pixels.size(); ++i) {
        if (isShaded(surface, block.pixels[i])) {
            places.push_back(i);
        }
    }
    return places;
}

} // namespace nacre
