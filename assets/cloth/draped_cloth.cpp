#include "assets/cloth/draped_cloth.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "assets/synth/smooth_noise.h"

namespace nacre {

namespace {

using glm::dvec3;

// Moves both ends towards their rest distance, each by half; a pinned one not at all.
void correct(ClothSheet& sheet, size_t a, size_t b, double rest, double share)
{
    const dvec3 apart = sheet.places[b] - sheet.places[a];
    const double length = glm::length(apart);
    const double weight = static_cast<double>(2 - sheet.pinned[a] - sheet.pinned[b]);
    if (weight == 0 || length == 0) {
        return;
    }
    const dvec3 move = apart * (share * (length - rest) / (length * weight));
    sheet.places[a] += move * static_cast<double>(1 - sheet.pinned[a]);
    sheet.places[b] -= move * static_cast<double>(1 - sheet.pinned[b]);
}

struct Link {
    int columns, rows;
    double share;
};

// Sweeps alternate in direction, so that the cloth does not creep to one side.
void correctAll(ClothSheet& sheet, const Link& link, bool backwards)
{
    const double rest = sheet.edge * std::hypot(link.columns, link.rows);
    const int columns = sheet.side - std::abs(link.columns), rows = sheet.side - link.rows;
    const int count = columns * rows;
    for (int i = 0; i < count; ++i) {
        const int k = backwards ? count - 1 - i : i;
        const int column = k % columns + (link.columns < 0 ? -link.columns : 0), row = k / columns;
        correct(sheet, sheet.index(column, row), sheet.index(column + link.columns, row + link.rows), rest, link.share);
    }
}

} // namespace

ClothSheet makeSheet(int side, double width, const std::function<dvec3(double, double)>& place)
{
    ClothSheet sheet{side, width / (side - 1), {}, std::vector<uint8_t>(static_cast<size_t>(side) * side, 0)};
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            sheet.places.push_back(place(column / (side - 1.0), row / (side - 1.0)));
        }
    }
    return sheet;
}

ClothSheet refinedSheet(const ClothSheet& sheet)
{
    const int side = 2 * sheet.side - 1;
    ClothSheet fine{side, 0.5 * sheet.edge, {}, std::vector<uint8_t>(static_cast<size_t>(side) * side, 0)};
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const int x = column / 2, y = row / 2, right = x + column % 2, up = y + row % 2;
            fine.places.push_back(0.25 * (sheet.places[sheet.index(x, y)] + sheet.places[sheet.index(right, y)] +
                                          sheet.places[sheet.index(x, up)] + sheet.places[sheet.index(right, up)]));
            if (right == x && up == y) {
                fine.pinned[fine.index(column, row)] = sheet.pinned[sheet.index(x, y)];
            }
        }
    }
    return fine;
}

void settle(ClothSheet& sheet, const ClothForces& forces, int steps)
{
    // Threads do not stretch, the weave shears easily, and bending resists over two edges' length.
    const Link links[] = {{1, 0, 1.0},
                          {0, 1, 1.0},
                          {1, 1, 0.15},
                          {-1, 1, 0.15},
                          {2, 0, forces.bending},
                          {0, 2, forces.bending},
                          {4, 0, 0.5 * forces.bending},
                          {0, 4, 0.5 * forces.bending}};
    std::vector<dvec3> before = sheet.places;
    const dvec3 fall(0, -forces.gravity * forces.stepSeconds * forces.stepSeconds, 0);
    for (int step = 0; step < steps; ++step) {
        for (size_t i = 0; i < sheet.places.size(); ++i) {
            const dvec3 moved = (sheet.places[i] - before[i]) * (1.0 - forces.damping);
            before[i] = sheet.places[i];
            sheet.places[i] += sheet.pinned[i] ? dvec3(0) : moved + fall;
        }
        for (const Link& link : links) {
            correctAll(sheet, link, step % 2 == 1);
        }
        for (size_t i = 0; forces.keepOutside && i < sheet.places.size(); ++i) {
            if (forces.keepOutside(sheet.places[i])) {
                before[i] = sheet.places[i];
            }
        }
    }
}

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
