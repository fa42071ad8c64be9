#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "assets/synth/interreflection.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// One smooth swelling (or dent, where height is negative) of a sphere: height (1 - (1 - cos angle) / width)^3 within
// its reach, 0 beyond; twice differentiable everywhere.
struct Bump {
    glm::dvec3 centre; // unit direction from the solid's middle
    double height;     // at the centre, in units of the picture's half width
    double width;      // 1 - cos of the angle that it reaches
};

// The solid |p| <= R(p / |p|), R = radius + bumps, about the origin: normals are exact, for the gradient is analytic.
class BumpySolid {
public:
    BumpySolid(double radius, std::vector<Bump> bumps);

    // Negative inside, 0 on the surface, growing outwards.
    double outside(const glm::dvec3& p) const;
    glm::dvec3 gradient(const glm::dvec3& p) const;
    // Unit, outwards, at a point of the surface.
    glm::dvec3 normal(const glm::dvec3& p) const;

    // z of the surface's point nearest to a camera that looks along -z at (x, y); empty beside the solid.
    std::optional<double> depthTowardsCamera(double x, double y) const;
    // The surface's point that a camera outside the solid sees towards `through`; empty beside the solid.
    std::optional<glm::dvec3> seenFrom(const glm::dvec3& camera, const glm::dvec3& through) const;
    // The surface's point in a direction (unit) from the solid's middle.
    glm::dvec3 pointTowards(const glm::dvec3& direction) const { return radiusTowards(direction) * direction; }
    // Whether the line between two surface points, which face each other, runs outside.
    bool sees(const glm::dvec3& from, const glm::dvec3& to) const;
    // Whether the ray from a surface point towards a distant light (unit direction) leaves the solid freely.
    bool reachesLight(const glm::dvec3& surfacePoint, const glm::dvec3& light) const;

private:
    std::optional<double> firstHit(const glm::dvec3& origin, const glm::dvec3& direction, double from, double to) const;
    double radiusTowards(const glm::dvec3& d) const;

    double radius_;
    std::vector<Bump> bumps_;
    double boundingRadius_; // of a sphere about the origin that holds the solid
    double slope_;          // no step of length s changes outside() by more than slope_ * s
};

// All fill most of a picture whose shorter side spans [-1, 1].
BumpySolid plainSphere();
BumpySolid bumpySolid();
// A ball with a hollow towards the camera, narrow at the bottom.
BumpySolid bowlSolid();

// Spread over all of the solid, back included, by a Fibonacci spiral of directions from its middle.
std::vector<SurfaceNode> nodesOf(const BumpySolid& solid, int count);

// Which of `materials` an object's point wears whose direction from the object's middle is `direction` (unit): patches
// of some 40 degrees, nearest-point cells around a Fibonacci spiral on the sphere, the materials in turn.
size_t patchMaterial(const glm::dvec3& direction, size_t materials);

// What a camera that looks along -z sees of a solid: pixel centres are sampled, so that every value is exact. On the
// plane z = 0 the picture's shorter side spans [-1, 1]; x right, y up, the picture's middle is the origin.
struct SolidView {
    NormalMap normals;                                               // confidence 1 on the solid
    std::vector<double> depth;                                       // z of the surface; 0 beside the solid
    std::vector<uint8_t> mask;                                       // 1 on the solid
    std::vector<uint32_t> seen;                                      // indices of the mask's pixels, ascending
    double cameraDistance = std::numeric_limits<double>::infinity(); // from the origin; infinite: orthographic

    glm::dvec2 planePoint(uint32_t pixel) const; // where the pixel's ray meets z = 0
    glm::dvec3 surfacePoint(uint32_t pixel) const
    {
        return {planePoint(pixel) * (1 - depth[pixel] / cameraDistance), depth[pixel]};
    }
    glm::dvec3 towardsCamera(uint32_t pixel) const; // unit, from the surface point
};

// `fieldOfView`: degrees that the picture's width covers; 0: the camera is distant.
SolidView viewOf(const BumpySolid& solid, int width, int height, int threads, double fieldOfView = 0);

} // namespace nacre
