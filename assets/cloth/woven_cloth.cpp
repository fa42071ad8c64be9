#include "assets/cloth/woven_cloth.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "assets/cloth/yarn.h"

namespace nacre {

namespace {

// Point papers: rows of weft, the uppermost last, # where the warp is on top. Satins are warp-faced, with a counter of
// 2 (five ends) and 3 (eight ends).
const std::vector<std::pair<std::string, std::vector<std::string>>>& pointPapers()
{
    static const std::vector<std::pair<std::string, std::vector<std::string>>> kPapers = {
        {"plain", {"#.", ".#"}},
        {"twill", {"##..", ".##.", "..##", "#..#"}},
        {"twill31", {"###.", ".###", "#.##", "##.#"}},
        {"satin5", {".####", "##.##", "####.", "#.###", "###.#"}},
        {"satin8", {".#######", "###.####", "######.#", "#.######", "####.###", "#######.", "##.#####", "#####.##"}},
    };
    return kPapers;
}

// The run of equal answers about 0; in every weave each yarn changes sides within the repeat.
WeavePattern::Float floatAbout(int repeat, const std::function<bool(int)>& above)
{
    WeavePattern::Float run{0, 1, above(0)};
    for (; above(run.first - 1) == run.above && run.length < repeat; ++run.length) {
        --run.first;
    }
    for (int next = 1; above(next) == run.above && run.length < repeat; ++next) {
        ++run.length;
    }
    return run;
}

} // namespace

WeavePattern::WeavePattern(const std::vector<std::string>& rows) : repeat_(static_cast<int>(rows.size()))
{
    for (int warp = 0; warp < repeat_; ++warp) {
        for (int weft = 0; weft < repeat_; ++weft) {
            onTop_.push_back(rows[weft][warp] == '#');
        }
    }
    for (int a = 0; a < repeat_; ++a) {
        for (int b = 0; b < repeat_; ++b) {
            warpFloats_.push_back(floatAbout(repeat_, [&](int step) { return warpIsOnTop(a, b + step); }));
            weftFloats_.push_back(floatAbout(repeat_, [&](int step) { return !warpIsOnTop(b + step, a); }));
        }
    }
}

WeavePattern WeavePattern::named(const std::string& name)
{
    const auto found = std::find_if(pointPapers().begin(), pointPapers().end(),
                                    [&](const auto& paper) { return paper.first == name; });
    assert(found != pointPapers().end());
    return WeavePattern(found->second);
}

std::vector<std::string> weaveNames()
{
    std::vector<std::string> names;
    for (const auto& paper : pointPapers()) {
        names.push_back(paper.first);
    }
    return names;
}

namespace {

using glm::dvec2;

constexpr double kYarnHalfWidth = 0.45; // of a yarn that nothing presses
constexpr double kYarnFlatness = 0.46;  // height of a yarn's section over its width
constexpr double kCrimp = 0.16;         // a yarn's middle rises and falls by so much at crossings
constexpr double kBulge = 0.09;         // a long float's middle rises further by so much
constexpr double kSpread = 0.30;        // a long float is wider in its middle by this share
constexpr double kYarnPliesDepth = 0.035;

// A yarn's place and shape where it crosses the others: along it, crossing k lies at k + 1/2.
struct YarnState {
    double middle; // height
    double spread; // share
};

// Between crossings on different sides a cosine; over a float the yarn relaxes, rises and flattens.
YarnState stateOf(const WeavePattern::Float& before, const WeavePattern::Float& after, double share)
{
    auto side = [](const WeavePattern::Float& f) { return f.above ? 1.0 : -1.0; };
    const double blend = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
    // The float that this point belongs to, and how much of it lies behind, from halfway between crossings.
    const bool first = share < 0.5;
    const WeavePattern::Float& own = first ? before : after;
    const double behind = (first ? share : share - 1.0) + 0.5 - own.first;
    const double arch = std::sin(std::numbers::pi * behind / own.length);
    const double relaxed = own.above ? arch * arch : 0.0;
    // Even a yarn that shows at one crossing alone swells there, where nothing presses it.
    const double rise = relaxed * (1.0 - 1.0 / own.length), swell = relaxed * (1.0 - 0.55 / own.length);
    return {kCrimp * (side(before) * (1.0 - blend) + side(after) * blend) + kBulge * rise, kSpread * swell};
}

class Weave {
public:
    Weave(const WovenClothOptions& options, double spacing)
        : options_(options), pattern_(WeavePattern::named(options.weave)), spacing_(spacing)
    {
    }

    // p in yarn spacings.
    ReliefPoint at(const dvec2& p) const
    {
        Found best;
        findHighest(p.x, p.y, kWarp, best);
        findHighest(p.y, p.x, kWeft, best);
        // Grooves are too shallow to change which yarn is seen.
        const Twist twist{options_.curl, kYarnPliesDepth, spacing_ / best.halfWidth, best.seed + 5};
        return {best.height + kYarnHalfWidth * twist.groove(best.along / kYarnHalfWidth, best.x), best.direction};
    }

private:
    static constexpr uint8_t kWarp = 0, kWeft = 1;

    // The yarn that is seen.
    struct Found {
        double height = -1e9, halfWidth = 0, along = 0, x = 0;
        uint64_t seed = 0;
        uint8_t direction = kWarp;
    };

    // Of the two yarns nearest to `across`; the third is never on top.
    void findHighest(double across, double along, uint8_t direction, Found& best) const
    {
        const int nearest = static_cast<int>(std::floor(across));
        const int next = across - nearest < 0.5 ? nearest - 1 : nearest + 1;
        considerYarn(nearest, across, along, direction, best);
        considerYarn(next, across, along, direction, best);
    }

    YarnState state(int yarn, double along, uint8_t direction) const
    {
        const double place = along - 0.5;
        const int crossing = static_cast<int>(std::floor(place));
        auto run = [&](int k) -> const WeavePattern::Float& {
            return direction == kWarp ? pattern_.warpFloat(yarn, k) : pattern_.weftFloat(yarn, k);
        };
        return stateOf(run(crossing), run(crossing + 1), place - crossing);
    }

    void considerYarn(int yarn, double across, double along, uint8_t direction, Found& best) const
    {
        const uint64_t seed = hashOf(options_.seed * 2 + direction, static_cast<uint64_t>(static_cast<int64_t>(yarn)));
        const double w = options_.wander;
        const double stray = 0.05 * knotValue(1, seed) + 0.06 * smoothNoise(0.37 * along, seed + 2);
        const double fromMiddle = across - (yarn + 0.5) - w * stray;
        constexpr double kReach = 0.85; // beyond, a neighbour always lies higher
        if (std::abs(fromMiddle) > kReach) {
            return;
        }
        const YarnState s = state(yarn, along + 0.06 * w * smoothNoise(0.3 * along, seed + 4), direction);
        const double swell = 0.06 * knotValue(0, seed) + 0.08 * smoothNoise(0.45 * along, seed + 1);
        const double halfWidth = kYarnHalfWidth * (1.0 + s.spread) * (1.0 + w * swell);
        // What a yarn gains in width it loses in height.
        const double thickness = kYarnFlatness * kYarnHalfWidth / (1.0 + s.spread);
        const double lift = w * (0.025 * smoothNoise(0.5 * along, seed + 3) + 0.02 * knotValue(2, seed));
        const double height = s.middle + lift + thickness * yarnSection(fromMiddle / halfWidth);
        if (height > best.height) {
            best = {height, halfWidth, along, fromMiddle / halfWidth, seed, direction};
        }
    }

    const WovenClothOptions& options_;
    WeavePattern pattern_;
    double spacing_;
};

} // namespace

Target wovenCloth(int width, int height, const WovenClothOptions& options, int threads)
{
    const double yarnsPerUnit = 0.5 * options.threads;
    const Weave weave(options, reliefSpacing(width, height) * yarnsPerUnit);
    return targetFromRelief(width, height, {"warp", "weft"}, inFolds(weave, yarnsPerUnit, options.drape, options.seed),
                            threads);
}

} // namespace nacre
