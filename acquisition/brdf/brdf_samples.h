#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "acquisition/near_field/local_lights.h"
#include "acquisition/normals/normals.h"
#include "engine/brdf/brdf_table.h"
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"
#include "shared/brdf_coords.h"

namespace nacre {

// M observations of one material.
struct BrdfSamples {
    TableDomain domain;
    std::vector<glm::vec3> unit;   // coordinates on the table's unit cube (brdf_coords.h)
    std::vector<glm::vec3> values; // f in 1/sr, up to the capture's scale factor
    // Trust over the standard deviation of f, > 0: noise is alike in the photographs, so that f = I / (a E n.l) has one
    // that falls with a n.l.
    std::vector<float> weights;

    size_t size() const { return values.size(); }
};

// Texels of a full table: MERL's density over thetaH, one every four degrees over phiD, along which f changes least.
constexpr int kThetaHTexels = 90;
int phiDTexels(const TableDomain& domain);

// Those with a positive weight and finite numbers. Throws Error where none is left.
BrdfSamples usableSamples(const BrdfSamples& samples);

struct SampleOptions {
    // Rejected below: at grazing light f = I / (E n.l) divides noise by little.
    float leastCosine = 0.1f;
    // At most this many samples; pixels are thinned evenly by a hash of their position.
    size_t most = 400000;
    int threads = 0;
};

struct SampleCounts {
    size_t used = 0;
    size_t shadowed = 0; // attached, cast or grazing
    size_t saturated = 0;
    size_t withoutNormal = 0; // observations of pixels that have none
    size_t thinned = 0;       // left out because `most` was reached
};

// Adds f_i = I_i / (a_p E_i n.l_i) of a block's pixels with their albedo factors a_p, each in its own frame, v =
// (0,0,1). `share` of the pixels is kept, so that the capture's total stays below `most`. Verdicts are obeyed: nothing
// in shadow and nothing saturated goes in.
void gatherSamples(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                   const LocalLights& lights, double share, const SampleOptions& options, BrdfSamples& samples,
                   SampleCounts& counts);

// The same of pixels whose factors and table are known by now, `albedo` over whole photographs: what the table says of
// an observation judges it in the verdicts' place. Its square weight is that of Cauchy's distribution with a scale of
// half of kRefitLimit, of the pixel's bright level or of what is predicted, whichever is more: a cast shadow counts
// little, and a highlight is not lost by a table that is too low there.
void gatherJudgedSamples(const Observations& block, const NormalMap& normals, const Image& albedo,
                         const LocalLights& lights, const BrdfTable& table, double share, const SampleOptions& options,
                         BrdfSamples& samples);

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
