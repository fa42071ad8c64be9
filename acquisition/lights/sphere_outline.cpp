#include "acquisition/lights/sphere_outline.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"

namespace nacre {

namespace {

// A border point counts as on the circle within this share of the radius, or 1.5 pixels on small spheres.
constexpr double kOnCircleShare = 0.02;
constexpr double kOnCirclePixels = 1.5;
// Share of border points that must lie on the circle, and of the circle that the mask must cover.
constexpr double kDiscShare = 0.8;

constexpr int kOutlineRefinements = 20;

using Point = glm::dvec2;

// Midpoints of the edges between inside and outside pixels.
std::vector<Point> borderOf(std::span<const uint8_t> mask, int width, int height)
{
    std::vector<Point> border;
    const auto inside = [&](int x, int y) { return mask[static_cast<size_t>(y) * width + x] != 0; };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (x + 1 < width && inside(x, y) != inside(x + 1, y)) {
                border.push_back({x + 1.0, y + 0.5});
            }
            if (y + 1 < height && inside(x, y) != inside(x, y + 1)) {
                border.push_back({x + 0.5, y + 1.0});
            }
        }
    }
    return border;
}

// Algebraic start: x^2 + y^2 = 2 a x + 2 b y + c (Kasa 1976).
Circle algebraicCircle(const std::vector<Point>& border)
{
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Point& p : border) {
        const Eigen::Vector3d row(2 * p.x, 2 * p.y, 1);
        normal += row * row.transpose();
        right += row * (p.x * p.x + p.y * p.y);
    }
    const Eigen::Vector3d s = normal.ldlt().solve(right);
    return {s.x(), s.y(), std::sqrt(std::max(0.0, s.z() + s.x() * s.x() + s.y() * s.y()))};
}

double radialResidual(const Circle& c, const Point& p)
{
    return std::hypot(p.x - c.x, p.y - c.y) - c.radius;
}

double medianAbsoluteResidual(const Circle& c, const std::vector<Point>& border)
{
    std::vector<double> residuals;
    for (const Point& p : border) {
        residuals.push_back(std::abs(radialResidual(c, p)));
    }
    std::nth_element(residuals.begin(), residuals.begin() + residuals.size() / 2, residuals.end());
    return residuals[residuals.size() / 2];
}

// One Gauss-Newton step on the radial residuals, weighted by Tukey's biweight (c = 4.685 sigma).
Circle stepTowards(const Circle& c, const std::vector<Point>& border)
{
    // Half a pixel is the border's own grain.
    const double cut = 4.685 * 1.4826 * std::max(medianAbsoluteResidual(c, border), 0.5);
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Point& p : border) {
        const double distance = std::max(std::hypot(p.x - c.x, p.y - c.y), 1e-9);
        const double residual = distance - c.radius;
        const double u = residual / cut;
        if (std::abs(u) >= 1) {
            continue;
        }
        const double weight = (1 - u * u) * (1 - u * u);
        const Eigen::Vector3d row((p.x - c.x) / distance, (p.y - c.y) / distance, 1);
        normal += weight * row * row.transpose();
        right += weight * row * residual;
    }
    const Eigen::Vector3d step = normal.ldlt().solve(right);
    return {c.x + step.x(), c.y + step.y(), c.radius + step.z()};
}

// Share of the circle's pixels inside the frame that the mask has, less what it has outside.
double coveredShare(const Circle& c, std::span<const uint8_t> mask, int width, int height)
{
    size_t both = 0, either = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool inCircle = std::hypot(x + 0.5 - c.x, y + 0.5 - c.y) < c.radius;
            const bool inMask = mask[static_cast<size_t>(y) * width + x] != 0;
            both += inCircle && inMask;
            either += inCircle || inMask;
        }
    }
    return either ? static_cast<double>(both) / static_cast<double>(either) : 0;
}

} // namespace

Circle refinedCircle(Circle circle, const std::vector<glm::dvec2>& border)
{
    for (int i = 0; i < kOutlineRefinements; ++i) {
        circle = stepTowards(circle, border);
    }
    return circle;
}

Circle fitCircle(std::span<const uint8_t> mask, int width, int height, const std::filesystem::path& source)
{
    const std::vector<Point> border = borderOf(mask, width, height);
    const char* expected = "the mask of a sphere: one filled disc";
    if (border.size() < 16) {
        throw Error(source, fmt::format("is no disc: its border has {} points", border.size()), expected);
    }
    const Circle circle = refinedCircle(algebraicCircle(border), border);
    const double tolerance = std::max(kOnCirclePixels, kOnCircleShare * circle.radius);
    const auto onCircle = std::count_if(
        border.begin(), border.end(), [&](const Point& p) { return std::abs(radialResidual(circle, p)) <= tolerance; });
    const double borderShare = static_cast<double>(onCircle) / static_cast<double>(border.size());
    const double covered = coveredShare(circle, mask, width, height);
    if (!(circle.radius > 0) || borderShare < kDiscShare || covered < kDiscShare) {
        throw Error(
            source,
            fmt::format("is no disc: {:.0f} % of its border lies on the best circle, which it covers to {:.0f} %",
                        100 * borderShare, 100 * covered),
            expected);
    }
    return circle;
}

glm::vec3 sphereNormal(const Circle& circle, double x, double y)
{
    const double nx = (x - circle.x) / circle.radius;
    const double ny = -(y - circle.y) / circle.radius;
    const double r2 = nx * nx + ny * ny;
    if (r2 >= 1) {
        const double r = std::sqrt(r2);
        return glm::vec3(nx / r, ny / r, 0);
    }
    return glm::vec3(nx, ny, std::sqrt(1 - r2));
}

NormalMap sphereNormals(const Circle& circle, int width, int height)
{
    NormalMap map(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec3 n = sphereNormal(circle, x + 0.5, y + 0.5);
            if (n.z > 0) {
                map.normals[map.index(x, y)] = n;
                map.confidence[map.index(x, y)] = 1;
            }
        }
    }
    return map;
}

} // namespace nacre
