#include "engine/lights/light_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace nacre {
namespace {

float cross(const glm::vec2& a, const glm::vec2& b)
{
    return a.x * b.y - a.y * b.x;
}

// One half of Andrew's monotone chain; without its last point, which begins the other half.
void addChain(const std::vector<glm::vec2>& sorted, std::vector<glm::vec2>& corners)
{
    const size_t first = corners.size();
    for (const glm::vec2& point : sorted) {
        while (corners.size() >= first + 2 &&
               cross(corners.back() - corners[corners.size() - 2], point - corners.back()) <= 0) {
            corners.pop_back();
        }
        corners.push_back(point);
    }
    corners.pop_back();
}

glm::vec2 nearestOnEdge(const glm::vec2& from, const glm::vec2& to, const glm::vec2& point)
{
    const glm::vec2 edge = to - from;
    const float length2 = glm::dot(edge, edge);
    const float along = length2 > 0 ? glm::clamp(glm::dot(point - from, edge) / length2, 0.0f, 1.0f) : 0.0f;
    return from + along * edge;
}

} // namespace

glm::vec2 lightPlanePoint(const glm::vec3& direction)
{
    const glm::vec2 point(direction.x, direction.y);
    if (direction.z >= 0) {
        return point;
    }
    const float radius = glm::length(point);
    return radius > 0 ? point * ((2 - radius) / radius) : glm::vec2(2, 0);
}

std::vector<glm::vec2> lightPlanePoints(std::span<const glm::vec3> directions)
{
    std::vector<glm::vec2> points;
    for (const glm::vec3& direction : directions) {
        points.push_back(lightPlanePoint(direction));
    }
    return points;
}

LightHull::LightHull(std::span<const glm::vec2> points)
{
    std::vector<glm::vec2> sorted(points.begin(), points.end());
    const auto before = [](const glm::vec2& a, const glm::vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); };
    std::sort(sorted.begin(), sorted.end(), before);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) {
        corners_ = sorted;
        return;
    }
    addChain(sorted, corners_);
    std::reverse(sorted.begin(), sorted.end());
    addChain(sorted, corners_);
}

glm::vec2 LightHull::nearest(const glm::vec2& point) const
{
    bool inside = corners_.size() >= 3;
    glm::vec2 best = point;
    float least = std::numeric_limits<float>::max();
    for (size_t i = 0; i < corners_.size(); ++i) {
        const glm::vec2 &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
        inside = inside && cross(to - from, point - from) >= 0;
        const glm::vec2 candidate = nearestOnEdge(from, to, point);
        if (glm::length(point - candidate) < least) {
            least = glm::length(point - candidate);
            best = candidate;
        }
    }
    return inside ? point : best;
}

double LightHull::area() const
{
    double sum = 0;
    for (size_t i = 0; i < corners_.size(); ++i) {
        sum += 0.5 * double{cross(corners_[i], corners_[(i + 1) % corners_.size()])};
    }
    return sum;
}

double meanSpacing(std::span<const glm::vec2> points)
{
    double sum = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        float nearest = std::numeric_limits<float>::max();
        for (size_t j = 0; j < points.size(); ++j) {
            nearest = i == j ? nearest : std::min(nearest, glm::length(points[i] - points[j]));
        }
        sum += points.size() > 1 ? nearest : 0;
    }
    return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

} // namespace nacre
