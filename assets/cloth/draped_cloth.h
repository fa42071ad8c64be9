#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "assets/synth/target.h"

namespace nacre {

// A square of cloth as a grid of particles, side x side; x right, y up, z towards the viewer. Row 0 is one hem.
struct ClothSheet {
    int side = 0;
    double edge = 0; // rest distance of neighbours
    std::vector<glm::dvec3> places;
    std::vector<uint8_t> pinned;

    size_t index(int column, int row) const { return static_cast<size_t>(row) * side + column; }
};

// `place` of (u, v) in [0,1]^2, u along a row.
ClothSheet makeSheet(int side, double width, const std::function<glm::dvec3(double, double)>& place);

// Twice as fine: places between are the neighbours' means; none of the new particles is pinned.
ClothSheet refinedSheet(const ClothSheet& sheet);

struct ClothForces {
    double gravity = 1;    // downwards, widths a second squared, about
    double damping = 0.02; // share of the velocity that a step takes away
    double bending = 0.2;  // share of a bend's correction that is applied: 0 = limp
    double stepSeconds = 0.004;
    // Moves a place out of a solid, true where it had to: there the cloth sticks. May be empty.
    std::function<bool(glm::dvec3&)> keepOutside;
};

// Falls `steps` steps by position-based dynamics (Mueller, Heidelberger, Hennix, Ratcliff, Position Based Dynamics,
// 2007), one thread: the order of corrections is part of the result.
void settle(ClothSheet& sheet, const ClothForces& forces, int steps);

// A large sheet that has fallen: hung from two points, or laid over a ball and seen a little from above.
struct DrapedClothOptions {
    std::string way = "hung"; // drapeNames()
    double stiffness = 0.1;   // 0 = limp, narrow folds; 1 = stiff, broad ones
    uint64_t seed = 1;        // of the disturbance that folds begin from
};

std::vector<std::string> drapeNames();

// Parts: face, reverse (where the sheet turns its other side to the viewer).
Target drapedCloth(int width, int height, const DrapedClothOptions& options = {}, int threads = 0);

// The smooth surface through about the sheet's particles (a bicubic B-spline's), seen by a distant camera that looks
// along -z; the picture's shorter side spans [-1, 1]. The side of rising u x v is part 0, the other part 1; both are
// shown with normals towards the viewer.
Target sheetPicture(const ClothSheet& sheet, int width, int height, std::vector<std::string> parts, int threads);

} // namespace nacre
