#pragma once
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "acquisition/exemplar/ball_grid.h"
#include "acquisition/exemplar/pixel_lattice.h"
#include "engine/brdf/brdf_models.h"

namespace nacre {

constexpr int kShadeKnots = 17; // n.l = 0, 1/16, ... 1
// Of n.l and of n.v from 0 to 1, and of thetaD up to the largest.
constexpr int kCouplingKnots = 5, kCouplingDifferences = 3;

// A grey reflectance as a fixed view sees it, up to each pixel's albedo a. What a pixel with normal n shows of a light
// of irradiance 1 is
//   a (T(thetaH, thetaD) e^u(n.l) n.l + b)       where gloss is scaled by the albedo, or
//   a (e^u(n.l) n.l + b) + T(thetaH, thetaD) n.l where gloss is common to the object (additive), whatever the albedo.
// u is how the diffuse part departs from Lambert's law: 0 is none. b is light that reaches the pixel by way of its
// surroundings, wherever the lamp stands: 0 is none. Where all pixels have one albedo, a e^v(n.v) stands for a, and
// u(n.l) + w(n.l, n.v, thetaD) for u: v is what albedos take elsewhere, and w, small and smooth, what of a measured
// material no product of functions of one or two angles holds.
struct Reflectance {
    bool additive = false;
    std::array<float, kShadeKnots> shade{}; // u
    float bounced = 0;                      // b
    std::optional<float> oneAlbedo;         // a, where all pixels have it
    std::array<float, kShadeKnots> slant{}; // v
    std::vector<float> coupling;            // w [(n.l * knots + n.v) * differences + thetaD]; empty: 0
    std::vector<float> lobe = std::vector<float>(kHalfBins * kDifferenceBins, 1.0f); // T [half * bins + difference]

    float shadeAt(float cosine) const;
    float slantAt(float cosine) const;
    float couplingAt(float nDotL, float nDotV, const LightPlace& light) const;
};

// w between the eight knots around it: w is the sum of the knots' values by their weights, and its derivatives by n.l
// and by n.v those by their slopes.
struct CouplingPlace {
    std::array<int, 8> knots{};
    std::array<float, 8> weights{}, slopesByL{}, slopesByV{};
};
CouplingPlace couplingPlace(float nDotL, float nDotV, const LightPlace& light);

// The least that additive gloss leaves of the diffuse part, where the measured one is negative.
constexpr float kLeastGlossShare = 0.05f;

// u of f proportional to (n.l)^(exponent - 1), 0 at n.l = 0.8.
std::array<float, kShadeKnots> shadeOfPower(float exponent);

// The reference balls of a reflectance: for each row of the grid what it shows under every light. A pixel's
// observations I are compared as g = sqrt(I / q), q its bright level: the root evens out the noise of bright and dark.
struct ReflectanceBall {
    const BallGrid* grid = nullptr;
    bool additive = false;
    std::vector<float> diffuse;  // [row * stride + light] what albedo 1 shows; additive: the diffuse part of it
    std::vector<float> gloss;    // additive alone: the rest
    std::vector<float> roots;    // multiplicative alone: square roots of `diffuse`
    std::vector<float> bright;   // per row, the bright level of `diffuse`
    std::vector<float> middling; // per row, kMiddling's quantile of it; both multiplicative alone
};

ReflectanceBall makeReflectanceBall(const BallGrid& grid, const Reflectance& reflectance, int threads);

// [row * stride + light] e^u(n.l), which reflectances of one u share.
std::vector<float> shadesOf(const BallGrid& grid, const Reflectance& reflectance, int threads);
ReflectanceBall makeReflectanceBall(const BallGrid& grid, const Reflectance& reflectance,
                                    const std::vector<float>& shades, int threads);

struct NamedReflectance {
    std::string name;
    Reflectance reflectance;
};

// Known reflectances to explain an object by. Built in: Lambert, and Lambert plus an ABC lobe over a grid of widths,
// tails and strengths, from matt to metal. `fitsFolder` (empty: none) adds the published fits, named merl-abc:NAME and
// merl-sgd:NAME. `excluded` leaves out published fits by NAME, in both families and with their numbered siblings
// (gold-paint takes gold-paint2 along). Tabulated up to the thetaD given, in radians.
std::vector<NamedReflectance> reflectanceDictionary(const std::filesystem::path& fitsFolder,
                                                    const std::vector<std::string>& excluded, float largestThetaD);

} // namespace nacre
