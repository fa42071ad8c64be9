#pragma once
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// Where a direction lies in the plane of lights: (x, y) in front, continued beyond the unit circle behind, so that the
// direction away from the camera is 2 from the middle.
glm::vec2 lightPlanePoint(const glm::vec3& direction);
std::vector<glm::vec2> lightPlanePoints(std::span<const glm::vec3> directions);

// The part of the plane that captured lights surround: their convex hull.
class LightHull {
public:
    explicit LightHull(std::span<const glm::vec2> points);

    // The point itself inside, else the nearest of the hull.
    glm::vec2 nearest(const glm::vec2& point) const;
    bool contains(const glm::vec2& point) const { return nearest(point) == point; }
    const std::vector<glm::vec2>& corners() const { return corners_; } // counter-clockwise
    // 0 where all points lie on a line.
    double area() const;

private:
    std::vector<glm::vec2> corners_;
};

// Mean distance of each point from its nearest neighbour; 0 of fewer than two.
double meanSpacing(std::span<const glm::vec2> points);

} // namespace nacre
