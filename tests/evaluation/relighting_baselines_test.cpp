// The rivals that relighting is judged against: what they can represent they must give back, and their weights are
// those of the textbook.
#include "evaluation/held_out/relighting_baselines.h"

#include <cmath>
#include <functional>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/rti/rti_picture.h"

namespace nacre {
namespace {

using Function = std::function<double(const glm::vec3&)>;
using Directions = std::vector<glm::vec3>;

glm::vec3 above(double x, double y)
{
    return {x, y, std::sqrt(1 - x * x - y * y)};
}

double predicted(const std::vector<float>& weights, const Directions& given, size_t asked, const Function& f)
{
    double sum = 0;
    for (size_t i = 0; i < given.size(); ++i) {
        sum += weights[asked * given.size() + i] * f(given[i]);
    }
    return sum;
}

void expectGivesBack(RelightingBaseline baseline, const Function& f, const Directions& asked)
{
    const Directions given = rtiLights(40);
    const std::vector<float> weights = relightingWeights(baseline, {}, given, asked);
    for (size_t j = 0; j < asked.size(); ++j) {
        EXPECT_NEAR(predicted(weights, given, j, f), f(asked[j]), 1e-4) << nameOf(baseline) << ", light " << j;
    }
}

double biquadraticOf(const glm::vec3& l)
{
    return 0.3 + 0.2 * l.x - 0.1 * l.y + 0.4 * l.x * l.x - 0.25 * l.x * l.y + 0.15 * l.y * l.y;
}

// The harmonics to the second order in terms of c = cos(theta), up to their factors (Gautron et al., Table 1).
double secondOrderOf(const glm::vec3& l)
{
    const double c = l.z, phi = std::atan2(l.y, l.x), s = std::sqrt(c - c * c);
    return 0.3 + 0.2 * (2 * c - 1) + s * (0.4 * std::cos(phi) - 0.3 * std::sin(phi)) + 0.1 * (1 - 6 * c + 6 * c * c) +
           s * (2 * c - 1) * (0.2 * std::cos(phi) + 0.1 * std::sin(phi)) +
           s * s * (0.5 * std::cos(2 * phi) - 0.2 * std::sin(2 * phi));
}

double thirdOrderOf(const glm::vec3& l)
{
    const double c = l.z, x = 2 * c - 1, phi = std::atan2(l.y, l.x), s = std::sqrt(c - c * c);
    return secondOrderOf(l) + 0.2 * (5 * x * x * x - 3 * x) / 2 + 0.1 * s * (5 * x * x - 1) * std::cos(phi) +
           0.2 * s * s * x * std::sin(2 * phi) + 0.3 * s * s * s * std::cos(3 * phi);
}

double affineOf(const glm::vec3& l)
{
    return 0.5 - 0.3 * l.x + 0.2 * l.y;
}

TEST(RelightingBaselines, GiveBackWhatTheyRepresent)
{
    const Directions asked = rtiCheckLights();
    expectGivesBack(RelightingBaseline::polynomialTextureMap, biquadraticOf, asked);
    expectGivesBack(RelightingBaseline::hemisphericalHarmonics, secondOrderOf, asked);
    expectGivesBack(RelightingBaseline::hemisphericalHarmonicsThird, thirdOrderOf, asked);
    expectGivesBack(RelightingBaseline::thinPlateSpline, affineOf, asked);
}

// Any function, at the given lights themselves.
TEST(RelightingBaselines, RadialFunctionsAndSplinesInterpolate)
{
    const Function peak = [](const glm::vec3& l) { return std::exp(-20 * (1 - l.z)) + 0.1 * l.x; };
    expectGivesBack(RelightingBaseline::radialBasisFunctions, peak, rtiLights(40));
    expectGivesBack(RelightingBaseline::thinPlateSpline, peak, rtiLights(40));
}

// Least squares of a biquadratic on a 3 x 3 grid, at its centre: 5/9 there, 2/9 at edges and -1/9 at corners (Savitzky
// and Golay's smoothing in two dimensions).
TEST(RelightingBaselines, ABiquadraticFitIsThatByHand)
{
    Directions given;
    for (const double y : {-0.5, 0.0, 0.5}) {
        for (const double x : {-0.5, 0.0, 0.5}) {
            given.push_back(above(x, y));
        }
    }
    const auto weights = relightingWeights(RelightingBaseline::polynomialTextureMap, {}, given, {above(0, 0)});
    const double expected[] = {-1, 2, -1, 2, 5, 2, -1, 2, -1};
    for (size_t i = 0; i < 9; ++i) {
        EXPECT_NEAR(weights[i], expected[i] / 9, 1e-5) << i;
    }
}

// On a ring of eight lights the harmonics are a Fourier series to cos 2 phi, whose least squares weigh a light by
// (1 + 2 cos d + 2 cos 2d) / 8, d its azimuth from the one asked.
TEST(RelightingBaselines, AHarmonicFitIsThatByHand)
{
    Directions given;
    for (int i = 0; i < 8; ++i) {
        given.push_back(above(0.6 * std::cos(M_PI / 4 * i), 0.6 * std::sin(M_PI / 4 * i)));
    }
    const glm::vec3 asked = above(0.6 * std::cos(M_PI / 8), 0.6 * std::sin(M_PI / 8));
    const auto weights = relightingWeights(RelightingBaseline::hemisphericalHarmonics, {}, given, {asked});
    // d = 22.5, 22.5, 67.5, 112.5, 157.5, 157.5, 112.5, 67.5 degrees.
    const double expected[] = {0.532747, 0.532747, 0.043894, -0.147447, 0.070807, 0.070807, -0.147447, 0.043894};
    for (size_t i = 0; i < 8; ++i) {
        EXPECT_NEAR(weights[i], expected[i], 1e-5) << i;
    }
}

// Two lights a chord of 1 apart, which is the Gaussians' width: K = (1 + penalty, 1/e; 1/e, 1 + penalty). The light
// between them has a chord of square 1/4 + (1 - sqrt(3/4))^2 = 0.267949 from both, so that each weighs
// e^-0.267949 / (1 + penalty + 1/e).
TEST(RelightingBaselines, AFitOfGaussiansIsThatByHand)
{
    const Directions given = {above(-0.5, 0), above(0.5, 0)};
    for (const auto& [penalty, expected] : {std::pair(0.0f, 0.559221), std::pair(0.5f, 0.409527)}) {
        const auto weights =
            relightingWeights(RelightingBaseline::radialBasisFunctions, {penalty, 1}, given, {above(0, 0)});
        EXPECT_NEAR(weights[0], expected, 1e-5);
        EXPECT_NEAR(weights[1], expected, 1e-5);
    }
}

// 1 and -1 in turn at the corners of a square of side 1: no affine part, factors of 1 and -1 over a common k with
// k phi(diagonal) = k ln 2 = 1, phi(side) = 0. At a quarter of the diagonal from the middle, squares of distances being
// 1/8, 9/8 and twice 5/8: (1/16 ln 1/8 + 9/16 ln 9/8 - 5/8 ln 5/8) / ln 2 = 0.331878.
TEST(RelightingBaselines, AThinPlateIsThatByHand)
{
    const Directions given = {above(0.5, 0.5), above(-0.5, 0.5), above(-0.5, -0.5), above(0.5, -0.5)};
    const Function turns = [](const glm::vec3& l) { return l.x * l.y > 0 ? 1.0 : -1.0; };
    const auto weights = relightingWeights(RelightingBaseline::thinPlateSpline, {}, given, {above(0.25, 0.25)});
    EXPECT_NEAR(predicted(weights, given, 0, turns), 0.331878, 1e-5);
}

} // namespace
} // namespace nacre
