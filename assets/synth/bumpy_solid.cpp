#include "assets/synth/bumpy_solid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"

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

std::optional<dvec3> BumpySolid::seenFrom(const dvec3& camera, const dvec3& through) const
{
    const dvec3 ray = glm::normalize(through - camera);
    const double along = -glm::dot(camera, ray), beside2 = glm::dot(camera, camera) - along * along,
                 reach2 = boundingRadius_ * boundingRadius_ - beside2;
    if (reach2 <= 0) {
        return std::nullopt;
    }
    const double reach = std::sqrt(reach2);
    const std::optional<double> t = firstHit(camera, ray, along - reach, along + reach);
    return t ? std::optional(camera + *t * ray) : std::nullopt;
}

bool BumpySolid::sees(const dvec3& from, const dvec3& to) const
{
    const double distance = glm::length(to - from);
    return !firstHit(from, (to - from) / distance, kLeastStep, distance - kLeastStep);
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

BumpySolid bowlSolid()
{
    return BumpySolid(0.95, {{{0.10, 0.15, 0.98}, -0.75, 0.70}});
}

// A direction's share w of the sphere covers the area w R^2 / (n.d) of the surface at R d.
std::vector<SurfaceNode> nodesOf(const BumpySolid& solid, int count)
{
    std::vector<SurfaceNode> nodes;
    for (int i = 0; i < count; ++i) {
        const dvec3 direction = spiralDirection(i, count), place = solid.pointTowards(direction),
                    normal = solid.normal(place);
        nodes.push_back(
            {place, normal, 4 * std::numbers::pi / count * glm::dot(place, place) / glm::dot(normal, direction)});
    }
    return nodes;
}

namespace {

constexpr int kPatches = 30;

// The spiral's axis is y, so that its uneven poles lie at the object's rim.
glm::dvec3 patchCentre(int i)
{
    const double y = 1 - (2 * i + 1) / static_cast<double>(kPatches);
    const double radius = std::sqrt(1 - y * y), azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    return {radius * std::cos(azimuth), y, radius * std::sin(azimuth)};
}

} // namespace

size_t patchMaterial(const glm::dvec3& direction, size_t materials)
{
    size_t nearest = 0;
    double closest = -2;
    for (int i = 0; i < kPatches; ++i) {
        const double cosine = glm::dot(direction, patchCentre(i));
        if (cosine > closest) {
            closest = cosine;
            nearest = static_cast<size_t>(i);
        }
    }
    return nearest % materials;
}

glm::dvec2 SolidView::planePoint(uint32_t pixel) const
{
    double halfSide = 0.5 * std::min(normals.width, normals.height);
    double x = pixel % normals.width + 0.5;
    double y = pixel / normals.width + 0.5; // row 0 is the top
    return {(x - 0.5 * normals.width) / halfSide, (0.5 * normals.height - y) / halfSide};
}

namespace {

std::optional<dvec3> seenThrough(const BumpySolid& solid, const glm::dvec2& onPlane, double cameraDistance)
{
    if (!std::isinf(cameraDistance)) {
        return solid.seenFrom({0, 0, cameraDistance}, {onPlane, 0});
    }
    const std::optional<double> depth = solid.depthTowardsCamera(onPlane.x, onPlane.y);
    return depth ? std::optional(dvec3(onPlane, *depth)) : std::nullopt;
}

} // namespace

dvec3 SolidView::towardsCamera(uint32_t pixel) const
{
    return std::isinf(cameraDistance) ? dvec3(0, 0, 1)
                                      : glm::normalize(dvec3(0, 0, cameraDistance) - surfacePoint(pixel));
}

SolidView viewOf(const BumpySolid& solid, int width, int height, int threads, double fieldOfView)
{
    SolidView view;
    if (fieldOfView > 0) {
        view.cameraDistance =
            width / static_cast<double>(std::min(width, height)) / std::tan(fieldOfView / 2 * std::numbers::pi / 180);
    }
    view.normals = NormalMap(width, height);
    view.depth.assign(view.normals.normals.size(), 0.0);
    view.mask.assign(view.depth.size(), 0);
    parallelFor(height, 8, threads, [&](size_t first, size_t last) {
        for (uint32_t pixel = first * width; pixel < last * width; ++pixel) {
            if (const std::optional<dvec3> point = seenThrough(solid, view.planePoint(pixel), view.cameraDistance)) {
                view.mask[pixel] = 1;
                view.depth[pixel] = point->z;
                view.normals.normals[pixel] = glm::vec3(solid.normal(*point));
                view.normals.confidence[pixel] = 1.0f;
            }
        }
    });
    for (uint32_t pixel = 0; pixel < view.mask.size(); ++pixel) {
        if (view.mask[pixel]) {
            view.seen.push_back(pixel);
        }
    }
    return view;
}

} // namespace nacre
