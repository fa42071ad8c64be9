#include "assets/cloth/draped_cloth.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "assets/cloth/cloth_sheet.h"
#include "assets/cloth/sheet_picture.h"
#include "assets/synth/smooth_noise.h"

namespace nacre {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr int kCoarseSide = 33; // particles; refined twice

// Large folds form on the coarse sheet, where corrections reach far; the fine ones only smooth and wrinkle them.
ClothSheet settledFinely(ClothSheet sheet, ClothForces forces)
{
    constexpr int kSteps[] = {4000, 500, 160};
    for (int steps : kSteps) {
        settle(sheet, forces, steps);
        if (steps != kSteps[2]) {
            sheet = refinedSheet(sheet);
            // A step's fall passes along a thread by one particle only, so that it stretches by the square of their
            // number.
            forces.stepSeconds *= 0.5;
        }
    }
    return sheet;
}

double disturbance(double u, double v, uint64_t seed)
{
    return 0.03 * smoothNoise(dvec2(7 * u, 5 * v), hashOf(seed)) +
           0.02 * smoothNoise(dvec2(15 * u, 11 * v), hashOf(seed) + 1);
}

// From two points of the upper hem, nearer to each other than along the cloth.
ClothSheet hungSheet(const DrapedClothOptions& options)
{
    constexpr double kWidth = 1.72, kNearer = 0.74, kTop = 0.86;
    ClothSheet sheet = makeSheet(kCoarseSide, kWidth, [&](double u, double v) {
        return dvec3((u - 0.5) * kWidth * kNearer, kTop - 0.07 * u - (1 - v) * kWidth,
                     0.05 * std::sin(11.0 * u + 1.0 + 1.5 * v) + disturbance(u, v, options.seed));
    });
    // Not quite alike, for no one hangs a cloth so.
    for (int column : {2, kCoarseSide - 6}) {
        sheet.pinned[sheet.index(column, kCoarseSide - 1)] = 1;
    }
    ClothForces forces;
    forces.bending = 0.05 * options.stiffness;
    return settledFinely(std::move(sheet), forces);
}

dvec3 turnedAboutX(const dvec3& p, double degrees)
{
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    return {p.x, c * p.y - s * p.z, s * p.y + c * p.z};
}

// Over a ball, then turned towards the viewer.
ClothSheet sheetOverBall(const DrapedClothOptions& options)
{
    constexpr double kWidth = 2.1, kRadius = 0.46, kSeenFromAbove = 30;
    ClothSheet sheet = makeSheet(kCoarseSide, kWidth, [&](double u, double v) {
        // A corner hangs in front.
        const dvec2 flat = dvec2(u - 0.5, v - 0.5) * kWidth;
        const double turn = 0.6;
        return dvec3(flat.x * std::cos(turn) - flat.y * std::sin(turn),
                     kRadius + 0.02 + disturbance(u, v, options.seed),
                     -(flat.x * std::sin(turn) + flat.y * std::cos(turn)));
    });
    ClothForces forces;
    forces.bending = 0.05 * options.stiffness;
    forces.keepOutside = [](dvec3& p) {
        const double length = glm::length(p);
        const bool inside = length < kRadius;
        if (inside) {
            p *= kRadius / length;
        }
        return inside;
    };
    sheet = settledFinely(std::move(sheet), forces);
    for (dvec3& place : sheet.places) {
        place = turnedAboutX(place, kSeenFromAbove) + dvec3(0, 0.28, 0);
    }
    return sheet;
}

} // namespace

std::vector<std::string> drapeNames()
{
    return {"hung", "ball"};
}

Target drapedCloth(int width, int height, const DrapedClothOptions& options, int threads)
{
    const ClothSheet sheet = options.way == "ball" ? sheetOverBall(options) : hungSheet(options);
    return sheetPicture(sheet, width, height, {"face", "reverse"}, threads);
}

} // namespace nacre
