#include "acquisition/residual/residual_rows.h"

#include <algorithm>

#include <glm/common.hpp>

#include "engine/scene/reference.h"

namespace nacre {
namespace {

const glm::vec3 kCamera(0, 0, 1);

} // namespace

ResidualRows residualRows(const Observations& block, std::span<const size_t> places, const Surface& surface)
{
    const size_t lights = block.lightCount;
    ResidualRows rows;
    rows.observed.resize(static_cast<Eigen::Index>(3 * places.size()), static_cast<Eigen::Index>(lights));
    rows.predicted.resizeLike(rows.observed);
    for (size_t p = 0; p < places.size(); ++p) {
        rows.pixels.push_back(block.pixels[places[p]]);
        for (size_t i = 0; i < lights; ++i) {
            const Light& light = surface.lights[i].light;
            const glm::vec3 predicted =
                brdfRadiance(surface, block.pixels[places[p]], {light.direction, glm::vec3(1)}, kCamera);
            glm::vec3 observed = block.radianceOf(places[p])[i] / light.irradiance;
            observed = block.saturatedOf(places[p])[i] != 0 ? glm::max(observed, predicted) : observed;
            for (int c = 0; c < 3; ++c) {
                const auto row = static_cast<Eigen::Index>(3 * p + c), column = static_cast<Eigen::Index>(i);
                rows.observed(row, column) = observed[c];
                rows.predicted(row, column) = predicted[c];
            }
        }
    }
    return rows;
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
