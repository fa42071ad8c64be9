#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/vec2.hpp>

#include "assets/synth/target.h"

namespace nacre {

// The centre line of a row of loops, one loop to the unit of x, cut into short straight pieces. It winds as
// x = t / 2 pi + a sin 2t, y = -h cos t, z = -d cos 2t: legs (t = pi/2) come towards the viewer, over the head of the
// loop below and the foot between two loops of the row above, which lie behind (after Peirce, Geometrical Principles
// Applicable to the Design of Functional Fabrics, 1947; Leaf and Glaskin, The Geometry of a Plain Knitted Loop, 1955).
class KnitLoop {
public:
    // A point of the line near the point asked for.
    struct Nearest {
        double across; // signed distance from it in the plane
        double along;  // its place along the line, in loop widths of yarn
        double z;
    };

    KnitLoop();

    // Calls visit(Nearest) for each piece that may be nearest to p, within kReach; p.y from the row's middle line.
    template <typename Visit> void visitNear(const glm::dvec2& p, const Visit& visit) const
    {
        const double loop = std::floor(p.x);
        const int row = static_cast<int>(std::floor((p.y + kHalfHeight + kReach) * kBins));
        if (row < 0 || row >= rows_) {
            return;
        }
        const glm::dvec2 within(p.x - loop, p.y);
        for (int piece : bins_[row * kBins + std::min(kBins - 1, static_cast<int>(within.x * kBins))]) {
            Nearest nearest = nearestOn(pieces_[piece], within);
            nearest.along += loop * length_;
            visit(nearest);
        }
    }

    static constexpr double kHalfHeight = 0.66; // h
    static constexpr double kReach = 0.36;

private:
    struct Piece {
        glm::dvec2 from, to;
        double fromZ, toZ, fromLength, toLength;
    };
    static Nearest nearestOn(const Piece& piece, const glm::dvec2& p);

    static constexpr int kBins = 16; // to the unit
    int rows_;
    double length_; // of a loop
    std::vector<Piece> pieces_;
    std::vector<std::vector<int>> bins_; // [row * kBins + column]: pieces within reach
};

// Stockinette seen from its face: rows (courses) of loops, each drawn through the loop below it from behind.
struct KnitOptions {
    int loops = 18;      // across the picture's shorter side
    double curl = 0.5;   // tangent of the yarn's twist angle
    double drape = 0.25; // slope of the long folds, rise over run
    double wander = 1;   // irregularity of the loops; 0 = a machine's drawing
    int stripes = 4;     // courses of one yarn before the other takes over
    uint64_t seed = 1;
};

// Parts: the two yarns of the stripes.
Target knit(int width, int height, const KnitOptions& options = {}, int threads = 0);

} // namespace nacre
