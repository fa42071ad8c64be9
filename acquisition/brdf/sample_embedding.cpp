#include "acquisition/brdf/sample_embedding.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {

glm::vec4 embeddedConfiguration(const TableDomain& domain, const glm::vec3& unit)
{
    if (domain.coordinates == kNatural) {
        const Natural c = naturalFromUnit(unit);
        const float g = std::sin(c.thetaI) * std::sin(c.thetaO);
        return {g * std::cos(c.phi), g * std::sin(c.phi), unit.x, c.thetaO};
    }
    const HalfDifference c = halfDifferenceFromUnit(unit, domain.thetaDMax);
    const float rg = unit.x * std::sin(c.thetaD);
    return {rg * std::cos(2 * c.phiD), rg * std::sin(2 * c.phiD), unit.x, c.thetaD};
}

float angularDistance(const TableDomain& domain, const glm::vec3& a, const glm::vec3& b)
{
    if (domain.coordinates == kNatural) {
        const Natural p = naturalFromUnit(a), q = naturalFromUnit(b);
        const float arc = (p.phi - q.phi) * std::sqrt(std::sin(p.thetaI) * std::sin(q.thetaI));
        return glm::length(glm::vec3(p.thetaI - q.thetaI, p.thetaO - q.thetaO, arc));
    }
    const HalfDifference p = halfDifferenceFromUnit(a, domain.thetaDMax),
                         q = halfDifferenceFromUnit(b, domain.thetaDMax);
    // An azimuth is an arc on the sphere of h and on that of d: the shorter one counts.
    const float sine = std::min(std::sin(p.thetaH) * std::sin(q.thetaH), std::sin(p.thetaD) * std::sin(q.thetaD));
    return glm::length(glm::vec3(p.thetaH - q.thetaH, p.thetaD - q.thetaD, (p.phiD - q.phiD) * std::sqrt(sine)));
}

} // namespace nacre
