#include "assets/cloth/cloth_sheet.h"

#include <cmath>

#include <glm/geometric.hpp>

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

} // namespace nacre
