#pragma once
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace nacre {

// What people relight such captures with today, for comparison only. Each fits every pixel by itself to what was seen
// under the given lights, and is linear in it: radiance over irradiance under a new light is a weighted sum of that
// under the given ones, with weights that depend on the directions alone.
enum class RelightingBaseline {
    polynomialTextureMap,        // Malzbender, Gelb, Wolters, Polynomial Texture Maps, 2001, Eq. 1
    hemisphericalHarmonics,      // Gautron et al., A Novel Hemispherical Basis, 2004: 9 terms, order 2
    hemisphericalHarmonicsThird, // 16 terms
    radialBasisFunctions,        // Gaussians about the given directions
    thinPlateSpline,             // over (l.x, l.y), affine part free: Wahba, Spline Models, 1990, Eq. 2.4
};

inline constexpr RelightingBaseline kRelightingBaselines[] = {
    RelightingBaseline::polynomialTextureMap, RelightingBaseline::hemisphericalHarmonics,
    RelightingBaseline::hemisphericalHarmonicsThird, RelightingBaseline::radialBasisFunctions,
    RelightingBaseline::thinPlateSpline};

std::string nameOf(RelightingBaseline baseline);

// How strongly a fit is held smooth: the penalty's factor, and the Gaussians' width in units of the lights' spacing.
struct Smoothing {
    float penalty = 0;
    float width = 1;
};

// What is worth trying.
std::vector<Smoothing> smoothingsOf(RelightingBaseline baseline);

// Weights [asked * given.size() + light] of the observations under the given lights, directions unit and towards the
// light.
std::vector<float> relightingWeights(RelightingBaseline baseline, const Smoothing& smoothing,
                                     const std::vector<glm::vec3>& given, const std::vector<glm::vec3>& asked);

} // namespace nacre
