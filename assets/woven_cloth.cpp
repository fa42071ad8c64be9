#include "assets/woven_cloth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "assets/hash_random.h"
#include "engine/scene/parallel_for.h"

namespace nacre {
namespace {

using glm::dvec2;
using glm::dvec3;
constexpr double kPi2 = 2.0 * std::numbers::pi;

// Samples a pixel's side: fibres are but a few pixels wide.
constexpr int kSubsamples = 2;
// Share of a yarn's half width where its section's ellipse gives way to its tangent, so that the weave has no holes.
constexpr double kSectionRim = 0.9;

// Smooth noise of one variable in [-1, 1], a new knot at every integer.
double waver(double t, uint64_t seed)
{
    double cell = std::floor(t);
    double s = t - cell;
    auto knot = [&](double i) {
        return 2.0 * unitFromHash(hashOf(seed, static_cast<uint64_t>(static_cast<int64_t>(i)))) - 1.0;
    };
    double blend = s * s * (3.0 - 2.0 * s);
    return knot(cell) * (1.0 - blend) + knot(cell + 1.0) * blend;
}

// One yarn in its own frame: `along` it and `across` from the middle of its place, one yarn spacing to the unit.
struct Yarn {
    int index = 0;
    uint64_t seed = 0; // tells warp from weft
    double side = 1;   // +1: on top where along + index is even, -1: where it is odd
};

// The upper half of the unit circle, carried on as a tangent beyond its rim.
double sectionHeight(double x)
{
    const double rimHeight = std::sqrt(1.0 - kSectionRim * kSectionRim);
    const double beyond = std::abs(x) - kSectionRim;
    return beyond <= 0.0 ? std::sqrt(1.0 - x * x) : rimHeight - beyond * kSectionRim / rimHeight;
}

// Height of the yarn's upper surface.
double yarnHeight(const WovenClothOptions& o, const Yarn& yarn, double along, double across)
{
    const uint64_t seed = hashOf(yarn.seed, static_cast<uint64_t>(static_cast<int64_t>(yarn.index)));
    const double halfWidth = 0.5 * o.cover * (1.0 + o.wander * waver(0.7 * along, seed));
    const double x = (across - o.wander * waver(0.45 * along, hashOf(seed))) / halfWidth;
    const double section = o.flatness * halfWidth * sectionHeight(x);
    const double parity = (yarn.index % 2 == 0 ? 1.0 : -1.0) * yarn.side;
    const double middle = 0.5 * o.crimp * o.flatness * parity * std::cos(std::numbers::pi * along);
    // Two strands' grooves wind about the yarn: the angle around it and the way along it turn together.
    const double twist = 2.6 * along + 0.7 * x + 0.25 * waver(1.3 * along, seed + 1);
    const double groove = 0.75 * std::sin(kPi2 * twist) + 0.25 * std::sin(kPi2 * (2.7 * twist + 0.3 * x));
    return middle + section + o.fibreDepth * groove * std::max(0.0, 1.0 - x * x);
}

struct Weave {
    const WovenClothOptions& options;

    double warp(int i, const dvec2& p) const { return yarnHeight(options, {i, 11, 1.0}, p.y - 0.5, p.x - (i + 0.5)); }
    double weft(int j, const dvec2& p) const { return yarnHeight(options, {j, 23, -1.0}, p.x - 0.5, p.y - (j + 0.5)); }

    // Gradient of the yarn that lies on top at p, from that yarn alone: differences across a rim mean nothing.
    dvec2 slope(const dvec2& p) const
    {
        int i = static_cast<int>(std::floor(p.x));
        int j = static_cast<int>(std::floor(p.y));
        bool warpOnTop = warp(i, p) >= weft(j, p);
        auto height = [&](const dvec2& q) { return warpOnTop ? warp(i, q) : weft(j, q); };
        constexpr double kStep = 1e-4;
        dvec2 dx(kStep, 0), dy(0, kStep);
        return dvec2(height(p + dx) - height(p - dx), height(p + dy) - height(p - dy)) / (2.0 * kStep);
    }
};

// Slope of a few long folds that cross the cloth; p in [-1, 1] over the shorter side.
dvec2 drapeSlope(const dvec2& p)
{
    struct Fold {
        dvec2 wave; // direction times angular frequency
        double phase;
        double share;
    };
    constexpr Fold kFolds[] = {{{2.6, 1.1}, 0.4, 0.5}, {{1.4, -2.3}, 1.9, 0.3}, {{5.2, 0.9}, 2.6, 0.2}};
    dvec2 slope(0);
    for (const Fold& fold : kFolds) {
        double bend = 0.35 * std::sin(1.7 * p.y + fold.phase);
        slope += glm::normalize(fold.wave) * fold.share * std::cos(glm::dot(fold.wave, p) + fold.phase + bend);
    }
    return slope;
}

// Rims stand almost upright; a slope of 3 (72 degrees) is as steep as cloth shows from the front.
dvec2 limited(const dvec2& slope)
{
    constexpr double kSteepest = 3.0;
    double steepness = glm::length(slope);
    return steepness > kSteepest ? slope * (kSteepest / steepness) : slope;
}

} // namespace

NormalMap wovenCloth(int width, int height, const WovenClothOptions& options)
{
    NormalMap map(width, height);
    const Weave weave{options};
    const double side = std::min(width, height);
    parallelFor(height, 4, options.threads, [&](size_t first, size_t last) {
        for (size_t pixel = first * width; pixel < last * width; ++pixel) {
            dvec3 sum(0);
            for (int s = 0; s < kSubsamples * kSubsamples; ++s) {
                double x = pixel % width + (s % kSubsamples + 0.5) / kSubsamples;
                double y = height - (pixel / width + (s / kSubsamples + 0.5) / kSubsamples); // up
                dvec2 yarns = dvec2(x, y) * (options.yarns / side);
                dvec2 drape = options.drapeSlope * drapeSlope(dvec2(2 * x - width, 2 * y - height) / side);
                sum += glm::normalize(dvec3(-limited(weave.slope(yarns)) - drape, 1.0));
            }
            map.normals[pixel] = glm::vec3(glm::normalize(sum));
            map.confidence[pixel] = 1.0f;
        }
    });
    return map;
}

} // namespace nacre
