#include "assets/cloth/knit.h"

#include "assets/cloth/cloth_folds.h"
#include "assets/cloth/knit_loop.h"
#include "assets/cloth/yarn.h"
#include "assets/synth/relief.h"

namespace nacre {
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
