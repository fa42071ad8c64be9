#include "acquisition/lights/edge_points.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {

namespace {

// Sobel's, per pixel.
glm::vec2 gradientAt(const Image& picture, int x, int y)
{
    const auto value = [&](int dx, int dy) { return picture.at(x + dx, y + dy); };
    return glm::vec2(value(1, -1) + 2 * value(1, 0) + value(1, 1) - value(-1, -1) - 2 * value(-1, 0) - value(-1, 1),
                     value(-1, 1) + 2 * value(0, 1) + value(1, 1) - value(-1, -1) - 2 * value(0, -1) - value(1, -1)) /
           8.0f;
}

Image gradientsOf(const Image& picture)
{
    Image gradients(picture.width, picture.height, 2);
    for (int y = 1; y + 1 < picture.height; ++y) {
        for (int x = 1; x + 1 < picture.width; ++x) {
            const glm::vec2 gradient = gradientAt(picture, x, y);
            gradients.at(x, y, 0) = gradient.x;
            gradients.at(x, y, 1) = gradient.y;
        }
    }
    return gradients;
}

} // namespace

Image boxAveraged(const Image& picture, int box)
{
    Image averaged(picture.width / box, picture.height / box, 1);
    for (int y = 0; y < averaged.height; ++y) {
        for (int x = 0; x < averaged.width; ++x) {
            float sum = 0;
            for (int step = 0; step < box * box; ++step) {
                sum += picture.at(x * box + step % box, y * box + step / box);
            }
            averaged.at(x, y) = sum / static_cast<float>(box * box);
        }
    }
    return averaged;
}

std::vector<EdgePoint> strongestEdges(const Image& picture, size_t most)
{
    const Image gradients = gradientsOf(picture);
    const auto lengthAt = [&](int x, int y) { return std::hypot(gradients.at(x, y, 0), gradients.at(x, y, 1)); };
    std::vector<EdgePoint> points;
    for (int y = 2; y + 2 < picture.height; ++y) {
        for (int x = 2; x + 2 < picture.width; ++x) {
            const float strength = lengthAt(x, y);
            if (!(strength > 0)) {
                continue;
            }
            const glm::vec2 direction = glm::vec2(gradients.at(x, y, 0), gradients.at(x, y, 1)) / strength;
            const int dx = static_cast<int>(std::lround(direction.x)), dy = static_cast<int>(std::lround(direction.y));
            if (strength > lengthAt(x - dx, y - dy) && strength >= lengthAt(x + dx, y + dy)) {
                points.push_back({{x + 0.5f, y + 0.5f}, direction, strength});
            }
        }
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const EdgePoint& a, const EdgePoint& b) { return a.strength > b.strength; });
    points.resize(std::min(points.size(), most));
    return points;
}

float sampleAt(const Image& picture, const glm::dvec2& at)
{
    const double x = std::clamp(at.x - 0.5, 0.0, picture.width - 1.0);
    const double y = std::clamp(at.y - 0.5, 0.0, picture.height - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
    const float fx = static_cast<float>(x - x0), fy = static_cast<float>(y - y0);
    return (1 - fy) * ((1 - fx) * picture.at(x0, y0) + fx * picture.at(x1, y0)) +
           fy * ((1 - fx) * picture.at(x0, y1) + fx * picture.at(x1, y1));
}

} // namespace nacre
