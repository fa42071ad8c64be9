#include "acquisition/lights/mirror_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/near_field/near_field.h"

namespace nacre {

namespace {

using Rays = std::vector<MirrorRay>;

constexpr double kSigmas = 3; // of the mean nearness
constexpr double kInfinite = std::numeric_limits<double>::infinity();

glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& direction)
{
    return v - glm::dot(v, direction) * direction;
}

glm::dvec3 meanDirection(const Rays& rays)
{
    glm::dvec3 sum(0);
    for (const MirrorRay& ray : rays) {
        sum += ray.direction;
    }
    return glm::normalize(sum);
}

// 1 / distance by how rays turn towards each other: seen from x, a light at the distance r along d stands towards
// d - x / r across d, to the first order. Least squares over the rays.
double nearnessOf(const Rays& rays)
{
    const glm::dvec3 direction = meanDirection(rays);
    glm::dvec3 middle(0);
    for (const MirrorRay& ray : rays) {
        middle += ray.from / static_cast<double>(rays.size());
    }
    double products = 0, squares = 0;
    for (const MirrorRay& ray : rays) {
        const glm::dvec3 offset = across(ray.from - middle, direction);
        products -= glm::dot(offset, ray.direction - direction);
        squares += glm::dot(offset, offset);
    }
    return squares > 0 ? products / squares : 0.0;
}

bool areNear(const std::vector<Rays>& rays)
{
    double sum = 0, squares = 0;
    for (const Rays& ofLight : rays) {
        const double nearness = nearnessOf(ofLight);
        sum += nearness;
        squares += nearness * nearness;
    }
    const double count = static_cast<double>(rays.size()), mean = sum / count;
    const double error = std::sqrt(std::max(0.0, squares / count - mean * mean) / std::max(1.0, count - 1));
    return mean > kSigmas * error && glm::degrees(std::atan(0.5 * mean)) > kHarmlessTurn;
}

// The point whose squared distances to the rays add up to least: sum (I - d d') (p - x) = 0.
glm::dvec3 crossing(const Rays& rays)
{
    Eigen::Matrix3d left = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const MirrorRay& ray : rays) {
        const Eigen::Vector3d d(ray.direction.x, ray.direction.y, ray.direction.z),
            x(ray.from.x, ray.from.y, ray.from.z);
        const Eigen::Matrix3d projection = Eigen::Matrix3d::Identity() - d * d.transpose();
        left += projection;
        right += projection * x;
    }
    const Eigen::Vector3d p = left.ldlt().solve(right);
    return {p.x(), p.y(), p.z()};
}

// The mean of where the rays leave the ball of that radius about the middle.
glm::dvec3 placeAt(const Rays& rays, double distance)
{
    glm::dvec3 sum(0);
    for (const MirrorRay& ray : rays) {
        const double along = glm::dot(ray.from, ray.direction), square = glm::dot(ray.from, ray.from);
        const double reach = std::sqrt(std::max(0.0, along * along - square + distance * distance)) - along;
        sum += ray.from + reach * ray.direction;
    }
    return distance * glm::normalize(sum);
}

Light lightAtPlace(const glm::dvec3& place)
{
    return {glm::vec3(glm::normalize(place)), glm::vec3(1), static_cast<float>(glm::length(place))};
}

double squaredDegrees(const glm::dvec3& a, const glm::dvec3& b)
{
    const double degrees = glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    return degrees * degrees;
}

// Of the light's rays to where it stands.
double squaredMiss(const Rays& rays, const Light& light)
{
    const glm::dvec3 direction(light.direction);
    double sum = 0;
    for (const MirrorRay& ray : rays) {
        const glm::dvec3 towards =
            std::isinf(light.distance) ? direction : static_cast<double>(light.distance) * direction - ray.from;
        sum += squaredDegrees(ray.direction, towards) / static_cast<double>(rays.size());
    }
    return sum;
}

std::string describePlaces(const std::vector<Light>& lights)
{
    const auto [least, most] = std::minmax_element(
        lights.begin(), lights.end(), [](const Light& a, const Light& b) { return a.distance < b.distance; });
    return fmt::format("their rays cross at {:.2g} to {:.2g} widths of the object", least->distance, most->distance);
}

} // namespace

MirrorLights lightsOfRays(const std::vector<std::vector<MirrorRay>>& rays, std::optional<double> distance)
{
    MirrorLights result;
    const bool isTold = distance && std::isfinite(*distance);
    const bool cross = !distance && rays.front().size() > 1 && areNear(rays);
    double squares = 0;
    for (const Rays& ofLight : rays) {
        const glm::dvec3 direction = meanDirection(ofLight);
        result.lights.push_back(isTold  ? lightAtPlace(placeAt(ofLight, *distance))
                                : cross ? lightAtPlace(crossing(ofLight))
                                        : Light{glm::vec3(direction), glm::vec3(1), static_cast<float>(kInfinite)});
        squares += squaredMiss(ofLight, result.lights.back());
    }
    result.apart = std::sqrt(squares / static_cast<double>(rays.size()));
    if (isTold) {
        result.placed = fmt::format("at {:g} widths of the object", *distance);
    } else if (cross) {
        result.placed = describePlaces(result.lights);
    }
    return result;
}

} // namespace nacre
