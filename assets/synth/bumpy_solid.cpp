#include "assets/synth/bumpy_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace nacre {
namespace {

using glm::dvec3;

// The shortest step of a ray: what is missed is a chord shorter than this, thus less than 1e-7 deep.
constexpr double kLeastStep = 5e-4;

// The directions of a fine spiral (1.4 degrees apart) bound the slope and the radius; between them both may grow a
// little.
constexpr int kBoundSamples = 20000;
constexpr double kSlopeMargin = 1.05;
constexpr double kRadiusMargin = 1.01;

dvec3 spiralDirection(int i, int count)
{
    double z = 1.0 - 2.0 * (i + 0.5) / count;
    double phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    double s = std::sqrt(1.0 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

// Where within [from, to] the ray crosses the surface; outside at `from`, inside at `to`.
double bisected(const BumpySolid& solid, const dvec3& origin, const dvec3& direction, double from, double to)
{
    for (int i = 0; i < 48; ++i) {
        double middle = 0.5 * (from + to);
        (solid.outside(origin + middle * direction) < 0.0 ? to : from) = middle;
    }
    return 0.5 * (from + to);
}

} // namespace

BumpySolid::BumpySolid(double radius, std::vector<Bump> bumps)
    : radius_(radius), bumps_(std::move(bumps)), boundingRadius_(0.0), slope_(1.0)
{
    for (Bump& bump : bumps_) {
        bump.centre = glm::normalize(bump.centre);
    }
    for (int i = 0; i < kBoundSamples; ++i) {
        dvec3 d = spiralDirection(i, kBoundSamples);
        double surface = radiusTowards(d);
        boundingRadius_ = std::max(boundingRadius_, surface * kRadiusMargin);
        slope_ = std::max(slope_, glm::length(gradient(d * surface)) * kSlopeMargin);
    }
}

double BumpySolid::radiusTowards(const dvec3& d) const
{
    double surface = radius_;
    for (const Bump& bump : bumps_) {
        double s = 1.0 - (1.0 - glm::dot(d, bump.centre)) / bump.width;
        if (s > 0.0) {
            surface += bump.height * s * s * s;
        }
    }
    return surface;
}

double BumpySolid::outside(const dvec3& p) const
{
    double r = glm::length(p);
    return r - radiusTowards(p / r);
}

// With d = p/r: grad r = d and grad (d.c) = (c - d (d.c)) / r.
dvec3 BumpySolid::gradient(const dvec3& p) const
{
    double r = glm::length(p);
    dvec3 d = p / r;
    dvec3 g = d;
    for (const Bump& bump : bumps_) {
        double cosine = glm::dot(d, bump.centre);
        double s = 1.0 - (1.0 - cosine) / bump.width;
        if (s > 0.0) {
            g -= 3.0 * bump.height * s * s / (bump.width * r) * (bump.centre - d * cosine);
        }
    }
    return g;
}

dvec3 BumpySolid::normal(const dvec3& p) const
{
    return glm::normalize(gradient(p));
}

std::optional<double> BumpySolid::firstHit(const dvec3& origin, const dvec3& direction, double from, double to) const
{
    double free = from;
    for (double t = from; t < to;) {
        double distance = outside(origin + t * direction);
        if (distance < 0.0) {
            return bisected(*this, origin, direction, free, t);
        }
        free = t;
        t += std::max(distance / slope_, kLeastStep);
    }
    return std::nullopt;
}

std::optional<double> BumpySolid::depthTowardsCamera(double x, double y) const
{
    double planeRadius2 = x * x + y * y;
    double bound2 = boundingRadius_ * boundingRadius_;
    if (planeRadius2 >= bound2) {
        return std::nullopt;
    }
    double reach = std::sqrt(bound2 - planeRadius2);
    std::optional<double> t = firstHit({x, y, 0}, {0, 0, -1}, -reach, reach);
    return t ? std::optional(-*t) : std::nullopt;
}

bool BumpySolid::reachesLight(const dvec3& surfacePoint, const dvec3& light) const
{
    if (glm::dot(gradient(surfacePoint), light) <= 0.0) {
        return false;
    }
    double along = glm::dot(surfacePoint, light);
    double beside2 = glm::dot(surfacePoint, surfacePoint) - along * along;
    double exit = std::sqrt(std::max(boundingRadius_ * boundingRadius_ - beside2, 0.0)) - along;
    return !firstHit(surfacePoint, light, kLeastStep, exit);
}

BumpySolid plainSphere()
{
    return BumpySolid(0.92, {});
}

BumpySolid bumpySolid()
{
    return BumpySolid(0.78, {
                                {{-0.45, 0.50, 0.74}, 0.25, 0.16},
                                {{0.55, 0.35, 0.76}, 0.18, 0.10},
                                {{0.10, -0.45, 0.89}, 0.23, 0.12},
                                {{-0.75, -0.30, 0.59}, 0.21, 0.20},
                                {{0.80, -0.35, 0.49}, 0.23, 0.18},
                                {{0.05, 0.90, 0.43}, 0.21, 0.22},
                                {{0.05, 0.12, 0.99}, -0.14, 0.08},
                                {{-0.40, -0.85, 0.34}, 0.18, 0.15},
                                {{0.45, -0.88, 0.16}, 0.11, 0.30},
                                {{-0.95, 0.25, 0.20}, 0.16, 0.14},
                                {{0.90, 0.30, 0.32}, -0.09, 0.10},
                                {{0.42, 0.02, 0.91}, 0.06, 0.02},
                            });
}

} // namespace nacre
