#include "acquisition/lights/circle_search.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "acquisition/lights/edge_points.h"
#include "acquisition/lights/sphere_outline.h"

namespace nacre {

namespace {

constexpr int kSearchSide = 300; // pixels, of the longer side, that the search works on
constexpr size_t kMostEdges = 3000;
// A circle that is a tenth of the edges is drawn once in a thousand.
constexpr int kTriples = 20000;
constexpr float kRadial = 0.92f;     // cosine between an edge's direction and the circle's radius: 23 degrees
constexpr float kNear = 1.5f;        // pixels from the circle, in the search
constexpr double kLeastSeen = 0.6;   // of the circle; a stand or a dull ground may take the rest
constexpr double kLeastRadius = 0.2; // of the shorter side
constexpr double kOutside = 0.03;    // of the radius that may lie beyond the picture
constexpr size_t kSectors = 180;
constexpr int kRays = 360;
constexpr uint64_t kSeed = 1; // of the triples

bool isPlausible(const Circle& c, int width, int height)
{
    const double margin = c.radius * (1 - kOutside);
    return c.radius >= kLeastRadius * std::min(width, height) && c.x >= margin && c.y >= margin &&
           c.x + margin <= width && c.y + margin <= height;
}

// Through three points; the radius is not finite where they lie on a line.
Circle circleThrough(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
{
    const glm::dvec2 u = b - a, v = c - a;
    const double cross = 2 * (u.x * v.y - u.y * v.x);
    const glm::dvec2 centre =
        glm::dvec2(v.y * glm::dot(u, u) - u.y * glm::dot(v, v), u.x * glm::dot(v, v) - v.x * glm::dot(u, u)) / cross;
    return {a.x + centre.x, a.y + centre.y, glm::length(centre)};
}

bool liesOn(const EdgePoint& point, const Circle& circle)
{
    const glm::vec2 radius = point.at - glm::vec2(circle.x, circle.y);
    const float distance = glm::length(radius);
    return std::abs(distance - static_cast<float>(circle.radius)) < kNear &&
           std::abs(glm::dot(radius, point.direction)) > kRadial * distance;
}

size_t seenSectors(const std::vector<EdgePoint>& edges, const Circle& circle)
{
    std::bitset<kSectors> seen;
    for (const EdgePoint& point : edges) {
        if (liesOn(point, circle)) {
            const double turns = std::atan2(point.at.y - circle.y, point.at.x - circle.x) / (2 * M_PI) + 0.5;
            seen.set(std::min(static_cast<size_t>(turns * kSectors), kSectors - 1));
        }
    }
    return seen.count();
}

std::optional<Circle> bestThroughTriples(const std::vector<EdgePoint>& edges, int width, int height)
{
    std::mt19937_64 random(kSeed); // its numbers are the standard's, alike everywhere
    std::optional<Circle> best;
    size_t mostSeen = 0;
    for (int i = 0; i < kTriples && edges.size() >= 3; ++i) {
        std::array<const EdgePoint*, 3> points;
        std::generate(points.begin(), points.end(), [&] { return &edges[random() % edges.size()]; });
        const Circle circle = circleThrough(points[0]->at, points[1]->at, points[2]->at);
        if (!std::isfinite(circle.radius) || !isPlausible(circle, width, height) ||
            !std::all_of(points.begin(), points.end(), [&](const auto* p) { return liesOn(*p, circle); })) {
            continue;
        }
        const size_t seen = seenSectors(edges, circle);
        if (seen > mostSeen) {
            mostSeen = seen;
            best = circle;
        }
    }
    return best;
}

// Where the picture changes most along a ray from the circle's centre, within `reach` pixels of the circle.
glm::dvec2 steepestOnRay(const Image& picture, const Circle& circle, double azimuth, double reach)
{
    constexpr double kStep = 0.25;
    const glm::dvec2 centre(circle.x, circle.y), ray(std::cos(azimuth), std::sin(azimuth));
    const auto change = [&](double r) {
        return std::abs(sampleAt(picture, centre + (r + 0.5) * ray) - sampleAt(picture, centre + (r - 0.5) * ray));
    };
    double steepest = 0, radius = circle.radius;
    for (double r = circle.radius - reach; r <= circle.radius + reach; r += kStep) {
        if (change(r) > steepest) {
            steepest = change(r);
            radius = r;
        }
    }
    double sum = 0, moment = 0; // the middle of the change: an edge is as wide as its blur
    for (double r = radius - 1.5; r <= radius + 1.5; r += kStep) {
        sum += change(r);
        moment += r * change(r);
    }
    return centre + (sum > 0 ? moment / sum : radius) * ray;
}

// Fits the circle to the edges on its rays; empty where too few of them are on one.
std::optional<Circle> fittedToRays(const Image& picture, Circle circle, double reach)
{
    std::vector<glm::dvec2> points;
    for (int pass = 0; pass < 2; ++pass) {
        points.clear();
        for (int i = 0; i < kRays; ++i) {
            points.push_back(steepestOnRay(picture, circle, 2 * M_PI * i / kRays, reach));
        }
        circle = refinedCircle(circle, points);
        reach = std::max(reach / 2, 2.0);
    }
    const double near = std::max(1.0, 0.01 * circle.radius);
    const auto on = std::count_if(points.begin(), points.end(), [&](const glm::dvec2& point) {
        return std::abs(std::hypot(point.x - circle.x, point.y - circle.y) - circle.radius) < near;
    });
    return static_cast<double>(on) >= kLeastSeen * kRays ? std::optional(circle) : std::nullopt;
}

} // namespace

std::optional<Circle> findCircle(const Image& picture)
{
    Image eye = picture; // square roots, so that a dark outline on darker ground counts as it does to the eye
    std::transform(eye.values.begin(), eye.values.end(), eye.values.begin(),
                   [](float value) { return std::sqrt(std::max(value, 0.0f)); });
    const int box = (std::max(eye.width, eye.height) + kSearchSide - 1) / kSearchSide;
    const Image small = boxAveraged(eye, box);
    const std::vector<EdgePoint> edges = strongestEdges(small, kMostEdges);
    std::optional<Circle> circle = bestThroughTriples(edges, small.width, small.height);
    if (!circle || static_cast<double>(seenSectors(edges, *circle)) < kLeastSeen * kSectors) {
        return std::nullopt;
    }
    circle = fittedToRays(eye, {circle->x * box, circle->y * box, circle->radius * box}, (kNear + 1) * box);
    return circle && isPlausible(*circle, eye.width, eye.height) ? circle : std::nullopt;
}

} // namespace nacre
