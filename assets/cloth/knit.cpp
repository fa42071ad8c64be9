#include "assets/cloth/knit.h"

#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "assets/cloth/yarn.h"

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

namespace {

using glm::dvec2;

// In loop widths.
constexpr double kCourse = 0.78;     // from a row to the next
constexpr double kHalfWidth = 0.235; // of the yarn
constexpr double kFlatness = 0.75;   // height of the yarn's section over its width
constexpr double kFloor = -0.42;     // what is seen between loops
constexpr double kPliesDepth = 0.05;

class Stockinette {
public:
    Stockinette(const KnitOptions& options, double spacing) : options_(options), spacing_(spacing) {}

    // p in loop widths.
    ReliefPoint at(const dvec2& p) const
    {
        constexpr double kTall = KnitLoop::kHalfHeight + KnitLoop::kReach;
        Found best{kFloor, 0, 0, 0};
        const int first = static_cast<int>(std::ceil((p.y - kTall) / kCourse));
        const int last = static_cast<int>(std::floor((p.y + kTall) / kCourse));
        for (int course = first; course <= last; ++course) {
            findHighest(p, course, best);
        }
        const Twist twist{options_.curl, kPliesDepth, spacing_ / kHalfWidth, seedOf(best.course) + 3};
        const double groove = kHalfWidth * twist.groove(best.along / kHalfWidth, best.x);
        return {best.height + (best.height > kFloor ? groove : 0.0), partOf(best.course)};
    }

private:
    struct Found {
        double height, along, x;
        int course;
    };

    uint64_t seedOf(int course) const
    {
        return hashOf(options_.seed, static_cast<uint64_t>(static_cast<int64_t>(course)));
    }

    uint8_t partOf(int course) const
    {
        const int stripe = static_cast<int>(std::floor(static_cast<double>(course) / options_.stripes));
        return static_cast<uint8_t>(stripe & 1);
    }

    // Each course strays by itself, so that no two loops are alike.
    dvec2 strayed(const dvec2& p, int course) const
    {
        const uint64_t seed = seedOf(course);
        const dvec2 stray(smoothNoise(dvec2(0.9 * p.x, 1.6 * p.y), seed),
                          smoothNoise(dvec2(1.1 * p.x, 1.3 * p.y), seed + 1));
        return p + options_.wander * 0.055 * stray;
    }

    void findHighest(const dvec2& p, int course, Found& best) const
    {
        const dvec2 inRow = strayed(p, course) - dvec2(0, course * kCourse);
        const double halfWidth =
            kHalfWidth * (1.0 + 0.07 * options_.wander * smoothNoise(0.8 * p.x, seedOf(course) + 2));
        loop_.visitNear(inRow, [&](const KnitLoop::Nearest& nearest) {
            const double x = nearest.across / halfWidth;
            constexpr double kHidden = 1.5; // there the section has sunk below the floor
            if (std::abs(x) > kHidden) {
                return;
            }
            const double height = nearest.z + kFlatness * halfWidth * yarnSection(x);
            if (height > best.height) {
                best = {height, nearest.along, x, course};
            }
        });
    }

    const KnitOptions& options_;
    double spacing_;
    KnitLoop loop_;
};

} // namespace

Target knit(int width, int height, const KnitOptions& options, int threads)
{
    const double loopsPerUnit = 0.5 * options.loops;
    const Stockinette fabric(options, reliefSpacing(width, height) * loopsPerUnit);
    return targetFromRelief(width, height, {"first yarn", "second yarn"},
                            inFolds(fabric, loopsPerUnit, options.drape, options.seed), threads);
}

} // namespace nacre
