#include "engine/brdf/brdf_audit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr double kFloorShare = 0.01; // of the peak, as in BrdfComparison

bool isFinite(const glm::vec3& f)
{
    return std::isfinite(f.x) && std::isfinite(f.y) && std::isfinite(f.z);
}

struct Pair {
    glm::vec3 there, back;
};

// Values both ways round; counts what is wrong with single ones on the way.
std::vector<Pair> gatherPairs(const BrdfFunction& f, size_t count, BrdfAudit& audit)
{
    std::vector<Pair> pairs;
    for (const LightView& d : comparisonConfigurations(count)) {
        const BrdfValue there = f(d.l, d.v), back = f(d.v, d.l);
        if (std::min(there.confidence, back.confidence) < kCoveredConfidence) {
            continue;
        }
        ++audit.configurations;
        if (!isFinite(there.value) || !isFinite(back.value)) {
            ++audit.notFinite;
            continue;
        }
        audit.negative += std::min({there.value.x, there.value.y, there.value.z}) < 0;
        pairs.push_back({there.value, back.value});
    }
    return pairs;
}

void auditPairs(const std::vector<Pair>& pairs, BrdfAudit& audit)
{
    if (pairs.empty()) {
        return;
    }
    audit.least = audit.most = pairs.front().there;
    for (const Pair& p : pairs) {
        audit.least = glm::min(audit.least, p.there);
        audit.most = glm::max(audit.most, p.there);
    }
    const double peak = std::max({audit.most.x, audit.most.y, audit.most.z});
    std::vector<float> errors;
    for (const Pair& p : pairs) {
        for (int c = 0; c < 3; ++c) {
            const double mean = 0.5 * (static_cast<double>(p.there[c]) + p.back[c]);
            const double least = std::max({mean, kFloorShare * peak, 1e-30});
            errors.push_back(static_cast<float>(std::abs(static_cast<double>(p.there[c]) - p.back[c]) / least));
        }
    }
    audit.reciprocityMost = *std::max_element(errors.begin(), errors.end());
    audit.reciprocityMedian = quantile(errors, 0.5);
    audit.reciprocity95 = quantile(errors, 0.95);
}

} // namespace

// Over half vectors, since that is where highlights are narrow: l mirrors v at h, dw_l = 4 (v.h) dw_h (Walter et al.,
// Microfacet Models for Refraction through Rough Surfaces, 2007, eq. 14), with thetaH = u^2 90 deg.
DirectionalAlbedo directionalAlbedo(const BrdfFunction& f, double thetaDegrees)
{
    constexpr int kU = 360, kPhi = 180;
    const double thetaV = glm::radians(thetaDegrees);
    const glm::dvec3 v(std::sin(thetaV), 0, std::cos(thetaV));
    const double pi = glm::radians(180.0);
    glm::dvec3 sum(0);
    double covered = 0, whole = 0;
    for (int i = 0; i < kU; ++i) {
        const double u = (i + 0.5) / kU, thetaH = u * u * pi / 2;
        const double solidAngle = std::sin(thetaH) * (pi * u / kU) * (2 * pi / kPhi);
        for (int j = 0; j < kPhi; ++j) {
            const double phi = (j + 0.5) * 2 * pi / kPhi;
            const glm::dvec3 h(std::sin(thetaH) * std::cos(phi), std::sin(thetaH) * std::sin(phi), std::cos(thetaH));
            const double vDotH = glm::dot(v, h);
            const glm::dvec3 l = 2 * vDotH * h - v;
            if (vDotH <= 0 || l.z <= 0) {
                continue;
            }
            const double weight = l.z * 4 * vDotH * solidAngle;
            const BrdfValue value = f(glm::vec3(l), glm::vec3(v));
            if (isFinite(value.value)) {
                sum += weight * glm::dvec3(value.value);
            }
            covered += value.confidence >= kCoveredConfidence ? weight : 0;
            whole += weight;
        }
    }
    return {thetaDegrees, glm::vec3(sum), covered / whole};
}

BrdfAudit auditBrdf(const BrdfFunction& f, int threads, size_t count)
{
    BrdfAudit audit;
    auditPairs(gatherPairs(f, count, audit), audit);
    audit.albedos.resize(std::size(kAuditDegrees));
    parallelFor(audit.albedos.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            audit.albedos[i] = directionalAlbedo(f, kAuditDegrees[i]);
        }
    });
    for (const DirectionalAlbedo& a : audit.albedos) {
        audit.largestAlbedo = std::max<double>(audit.largestAlbedo, std::max({a.albedo.x, a.albedo.y, a.albedo.z}));
    }
    return audit;
}

} // namespace nacre
