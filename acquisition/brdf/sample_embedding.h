#pragma once
#include <glm/vec4.hpp>

#include "shared/brdf_coords.h"

namespace nacre {

// How far apart two configurations are, for finding neighbours.
struct SampleMetric {
    // Azimuth against thetaH: a BRDF changes less about the half vector than away from the normal.
    float azimuth = 0.5f;
    // Per radian of thetaD: small, so that neighbours come from the planes of several lights. All samples of one
    // photograph have the same thetaD.
    float thetaD = 0.35f;
};

// A table's unit coordinates as a point of a space in which equal configurations are equal points and nothing wraps.
// Half-difference: (r g cos 2 phiD, r g sin 2 phiD, r, thetaD) with r = sqrt(thetaH / (pi/2)) and g = sin thetaD, since
// phiD means nothing at thetaH = 0 and at thetaD = 0. Natural: the same with g = sin thetaI sin thetaO about phi.
// Without scales of axes: see embeddedPoint.
glm::vec4 embeddedConfiguration(const TableDomain& domain, const glm::vec3& unit);

inline glm::vec4 embeddedPoint(const glm::vec4& configuration, const SampleMetric& metric)
{
    return configuration * glm::vec4(metric.azimuth, metric.azimuth, 1.0f, metric.thetaD);
}

// Radians between the configurations of two unit coordinates, arcs of azimuth shortened as they are on the sphere.
float angularDistance(const TableDomain& domain, const glm::vec3& a, const glm::vec3& b);

} // namespace nacre
