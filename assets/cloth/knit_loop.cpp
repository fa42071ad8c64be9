#include "assets/cloth/knit_loop.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace nacre {
namespace {

using glm::dvec2;
using glm::dvec3;

constexpr double kPi2 = 2.0 * std::numbers::pi;
constexpr double kLean = 0.18;  // a: legs lean outwards to a V
constexpr double kDepth = 0.13; // d
constexpr int kPieces = 64;     // of a loop; at its bends the line turns by some 12 degrees a piece

dvec3 centreLine(double t)
{
    return {t / kPi2 + kLean * std::sin(2.0 * t), -KnitLoop::kHalfHeight * std::cos(t), -kDepth * std::cos(2.0 * t)};
}

double clampedShare(const dvec2& p, const dvec2& from, const dvec2& to)
{
    const dvec2 step = to - from;
    return std::clamp(glm::dot(p - from, step) / glm::dot(step, step), 0.0, 1.0);
}

} // namespace

KnitLoop::KnitLoop() : rows_(static_cast<int>(std::ceil(2.0 * (kHalfHeight + kReach) * kBins))), bins_(rows_ * kBins)
{
    // The neighbouring loops reach into this one's width.
    double length = 0;
    for (int i = -kPieces; i < 2 * kPieces; ++i) {
        const dvec3 from = centreLine(kPi2 * i / kPieces), to = centreLine(kPi2 * (i + 1) / kPieces);
        const double next = length + glm::length(to - from);
        pieces_.push_back({dvec2(from), dvec2(to), from.z, to.z, length, next});
        length = next;
    }
    length_ = length / 3.0;
    const double binReach = kReach + 0.75 / kBins; // from a bin's middle to its corners
    for (int bin = 0; bin < rows_ * kBins; ++bin) {
        const dvec2 middle((bin % kBins + 0.5) / kBins, (bin / kBins + 0.5) / kBins - kHalfHeight - kReach);
        for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
            const double share = clampedShare(middle, pieces_[i].from, pieces_[i].to);
            if (glm::distance(middle, glm::mix(pieces_[i].from, pieces_[i].to, share)) < binReach) {
                bins_[bin].push_back(i);
            }
        }
    }
}

KnitLoop::Nearest KnitLoop::nearestOn(const Piece& piece, const dvec2& p)
{
    const double share = clampedShare(p, piece.from, piece.to);
    const dvec2 step = piece.to - piece.from, away = p - glm::mix(piece.from, piece.to, share);
    const double side = step.x * away.y - step.y * away.x;
    return {std::copysign(glm::length(away), side), glm::mix(piece.fromLength, piece.toLength, share),
            glm::mix(piece.fromZ, piece.toZ, share)};
}

} // namespace nacre
