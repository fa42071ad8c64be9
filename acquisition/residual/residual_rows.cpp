#include "acquisition/residual/residual_rows.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>

#include "engine/scene/ball.h"
#include "engine/scene/reference.h"
#include "engine/surface/object_places.h"
#include "shared/ball.h"

namespace nacre {

namespace {

// Side by side, so that one texel answers for all lights.
std::vector<float> ballsOf(const Surface& surface, const BrdfTable& table, int size, int threads)
{
    const size_t lights = surface.lights.size(), texels = static_cast<size_t>(size) * size;
    std::vector<float> balls(3 * lights * texels);
    for (size_t i = 0; i < lights; ++i) {
        const Light unit{surface.lights[i].light.direction, glm::vec3(1)};
        const Ball ball = makeBall(table, std::span(&unit, 1), size, threads);
        for (size_t texel = 0; texel < texels; ++texel) {
            for (size_t c = 0; c < 3; ++c) {
                balls[(3 * texel + c) * lights + i] = ball.radiance.values[3 * texel + c];
            }
        }
    }
    return balls;
}

} // namespace

std::vector<Light> unitLights(const Surface& surface)
{
    std::vector<Light> lights;
    for (const CapturedLight& captured : surface.lights) {
        lights.push_back(captured.light);
        lights.back().irradiance = glm::vec3(1);
    }
    return lights;
}

bool isPlaced(const Surface& surface)
{
    return needsPlaces(surface, unitLights(surface), kFrontView);
}

LightBalls::LightBalls(const Surface& surface, int size, int threads)
    : surface_(surface), size_(size), met_(surface, unitLights(surface), kFrontView)
{
    assert(size == 0 || !isPlaced(surface));
    if (size > 0) {
        for (const Material& material : surface.materials) {
            materials_.push_back(ballsOf(surface, material.table, size, threads));
        }
    }
}

void LightBalls::addTexel(const float* texel, float share, const glm::vec3& albedo, std::span<float> predicted) const
{
    const size_t lights = surface_.lights.size();
    for (size_t c = 0; c < 3; ++c) {
        const float factor = share * albedo[static_cast<int>(c)];
        for (size_t i = c * lights; i < (c + 1) * lights; ++i) {
            predicted[i] += factor * texel[i];
        }
    }
}

void LightBalls::predict(size_t pixel, std::span<float> predicted) const
{
    std::fill(predicted.begin(), predicted.end(), 0.0f);
    size_ == 0 ? askTable(pixel, predicted) : askBall(pixel, predicted);
}

void LightBalls::askTable(size_t pixel, std::span<float> predicted) const
{
    const size_t lights = met_.size();
    const glm::vec3 view = met_.view(pixel);
    for (size_t i = 0; i < lights; ++i) {
        const PixelLights::Met met = met_.at(i, pixel);
        const glm::vec3 radiance = met.share * brdfRadiance(surface_, pixel, met.light, view);
        for (size_t c = 0; c < 3; ++c) {
            predicted[c * lights + i] = radiance[static_cast<int>(c)];
        }
    }
}

void LightBalls::askBall(size_t pixel, std::span<float> predicted) const
{
    const glm::vec3& normal = surface_.normals.normals[pixel];
    if (normal.z <= 0) {
        return;
    }
    const size_t lights = met_.size();
    const std::vector<float>& balls = materials_[surface_.labels[pixel]];
    const glm::vec3 albedo = albedoFactor(surface_, pixel);
    const glm::vec2 place = ballTexelFromNormal(normal, static_cast<float>(size_)) * static_cast<float>(size_) - 0.5f;
    const glm::ivec2 corner = glm::clamp(glm::ivec2(place), glm::ivec2(0), glm::ivec2(size_ - 2));
    const glm::vec2 t = place - glm::vec2(corner);
    for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const glm::vec2 shares = glm::mix(1.0f - t, t, glm::vec2(step));
        const size_t texel = static_cast<size_t>(corner.y + step.y) * size_ + corner.x + step.x;
        addTexel(&balls[texel * 3 * lights], shares.x * shares.y, albedo, predicted);
    }
    for (size_t i = 0; i < lights && !surface_.horizon.empty(); ++i) {
        const float share = met_.at(i, pixel).share;
        for (size_t c = 0; c < 3; ++c) {
            predicted[c * lights + i] *= share;
        }
    }
}

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
