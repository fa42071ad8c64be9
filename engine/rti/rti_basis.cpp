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

} // namespace

// Shifted Legendre functions of 2 cos(theta) - 1 times cos or sin of m phi; even m with the sign of `relight`.
std::vector<double> hemisphericalHarmonics(const glm::vec3& light, int order)
{
    using std::numbers::pi;
    const double z = std::clamp<double>(light.z, -1, 1);
    const double theta = std::min(std::acos(z), pi / 2 - kLowestRtiLight);
    const double argument = 2 * std::cos(theta) - 1, phi = std::atan2(double{light.y}, double{light.x});
    std::vector<double> values;
    for (int l = 0; l <= order; ++l) {
        for (int m = -l; m <= l; ++m) {
            const int k = std::abs(m);
            const double square = (2 * l + 1) * std::tgamma(l - k + 1) / (2 * pi * std::tgamma(l + k + 1));
            const double legendre = std::assoc_legendre(static_cast<unsigned>(l), static_cast<unsigned>(k), argument);
            const double azimuth = m < 0 ? std::cos(k * phi) : std::sin(k * phi);
            const double sign = k % 2 ? 1 : -1;
            values.push_back(std::sqrt(square) * legendre * (m == 0 ? 1 : sign * std::sqrt(2.0) * azimuth));
        }
    }
    return values;
}

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
    return basis == RtiBasis::ptm ? biquadratic(light.x, light.y) : hemisphericalHarmonics(light, 2);
}

} // namespace nacre
