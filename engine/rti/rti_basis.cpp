#include "engine/rti/rti_basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nacre {

namespace {

std::vector<double> biquadratic(double x, double y)
{
    return {1, x, y, x * x, x * y, y * y};
}

// Shifted Legendre functions of 2 cos(theta) - 1, written out, times cos or sin of m phi.
std::vector<double> hemisphericalHarmonics(const glm::dvec3& light)
{
    using std::numbers::pi;
    const double theta = std::min(std::acos(std::clamp(light.z, -1.0, 1.0)), pi / 2 - kLowestRtiLight);
    const double phi = std::atan2(light.y, light.x);
    const double c = std::cos(theta);
    const double s = std::sqrt(c - c * c);
    return {1 / std::sqrt(2 * pi),
            std::sqrt(6 / pi) * s * std::cos(phi),
            std::sqrt(3 / (2 * pi)) * (2 * c - 1),
            std::sqrt(6 / pi) * s * std::sin(phi),
            -std::sqrt(30 / pi) * s * s * std::cos(2 * phi),
            std::sqrt(30 / pi) * (2 * c - 1) * s * std::cos(phi),
            std::sqrt(5 / (2 * pi)) * (1 - 6 * c + 6 * c * c),
            std::sqrt(30 / pi) * (2 * c - 1) * s * std::sin(phi),
            -std::sqrt(30 / pi) * s * s * std::sin(2 * phi)};
}

} // namespace

std::string rtiBasisName(RtiBasis basis)
{
    return basis == RtiBasis::ptm ? "ptm" : "hsh";
}

size_t rtiTermCount(RtiBasis basis)
{
    return basis == RtiBasis::ptm ? 6 : 9;
}

std::vector<double> rtiWeights(RtiBasis basis, const glm::vec3& light)
{
    return basis == RtiBasis::ptm ? biquadratic(light.x, light.y) : hemisphericalHarmonics(light);
}

} // namespace nacre
