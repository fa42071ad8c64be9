// Weaves, loops, sheets and letters: the structure under the targets.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "assets/cloth/draped_cloth.h"
#include "assets/cloth/knit.h"
#include "assets/cloth/woven_cloth.h"
#include "assets/letters/embossed_letters.h"

namespace nacre {
namespace {

struct WeaveFacts {
    const char* name;
    int repeat;
    int up;           // crossings of a repeat of one warp yarn at which it lies on top
    int longestFloat; // of the warp
};

TEST(WeavePattern, EveryYarnInterlacesAsTheWeaveSays)
{
    const WeaveFacts kFacts[] = {
        {"plain", 2, 1, 1}, {"twill", 4, 2, 2}, {"twill31", 4, 3, 3}, {"satin5", 5, 4, 4}, {"satin8", 8, 7, 7}};
    for (const WeaveFacts& facts : kFacts) {
        const WeavePattern pattern = WeavePattern::named(facts.name);
        for (int i = -facts.repeat; i < facts.repeat; ++i) {
            int warpUp = 0, weftDown = 0, longest = 0;
            for (int k = 0; k < facts.repeat; ++k) {
                warpUp += pattern.warpIsOnTop(i, k);
                weftDown += pattern.warpIsOnTop(k, i);
                longest = std::max(longest, pattern.warpFloat(i, k).length);
                EXPECT_EQ(pattern.warpIsOnTop(i, k), pattern.warpIsOnTop(i + facts.repeat, k - facts.repeat));
                EXPECT_EQ(pattern.warpFloat(i, k).above, pattern.warpIsOnTop(i, k));
                EXPECT_EQ(pattern.weftFloat(i, k).above, !pattern.warpIsOnTop(k, i));
                // The float begins where it says, and what lies before it is on the other side.
                const int first = k + pattern.warpFloat(i, k).first;
                EXPECT_EQ(pattern.warpIsOnTop(i, first), pattern.warpIsOnTop(i, k));
                EXPECT_NE(pattern.warpIsOnTop(i, first - 1), pattern.warpIsOnTop(i, k));
            }
            EXPECT_EQ(warpUp, facts.up) << facts.name;
            EXPECT_EQ(weftDown, facts.up) << facts.name;
            EXPECT_EQ(longest, facts.longestFloat) << facts.name;
        }
    }
}

TEST(WeavePattern, TwillsStepByOneAndSatinsNeverTouch)
{
    for (const char* name : {"twill", "twill31"}) {
        const WeavePattern twill = WeavePattern::named(name);
        for (int k = 0; k < 4; ++k) {
            EXPECT_EQ(twill.warpIsOnTop(1, k), twill.warpIsOnTop(2, k + 1)) << name;
        }
    }
    for (const char* name : {"satin5", "satin8"}) {
        const WeavePattern satin = WeavePattern::named(name);
        for (int i = 0; i < 8; ++i) {
            for (int k = 0; k < 8; ++k) {
                const bool interlaced = !satin.warpIsOnTop(i, k);
                EXPECT_FALSE(interlaced && (!satin.warpIsOnTop(i + 1, k + 1) || !satin.warpIsOnTop(i + 1, k - 1)))
                    << name;
            }
        }
    }
}

TEST(WovenCloth, ShowsTheYarnThatThePatternPutsOnTop)
{
    for (const std::string& weave : weaveNames()) {
        WovenClothOptions options;
        options.weave = weave;
        options.threads = 16;
        options.drape = 0;
        options.wander = 0;
        const Target cloth = wovenCloth(128, 128, options); // 8 pixels a yarn, an even number of yarns about the middle
        const WeavePattern pattern = WeavePattern::named(weave);
        for (int warp = -8; warp < 8; ++warp) {
            for (int weft = -8; weft < 8; ++weft) {
                const int x = 64 + 8 * warp + 4, y = 64 - (8 * weft + 4);
                EXPECT_EQ(cloth.labels[cloth.normals.index(x, y)] == 0, pattern.warpIsOnTop(warp, weft)) << weave;
            }
        }
    }
}

// A loop's legs lie over the head of the loop below and over the feet of the row above; with one course to a stripe
// labels tell the courses apart.
TEST(KnitSlow, LegsLieOnTopOfHeadsAndFeet)
{
    KnitOptions options;
    options.loops = 8;
    options.drape = 0;
    options.wander = 0;
    options.stripes = 1;
    constexpr int kSize = 512;
    const Target fabric = knit(kSize, kSize, options);
    const KnitLoop loop;
    size_t legs = 0;
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::dvec2 p((x + 0.5) / 64 - 4, 4 - (y + 0.5) / 64);
            constexpr double kCourse = 0.78;
            const int course = static_cast<int>(std::floor(p.y / kCourse + 0.5));
            bool onLeg = false;
            loop.visitNear(p - glm::dvec2(0, course * kCourse), [&](const KnitLoop::Nearest& nearest) {
                onLeg |= std::abs(nearest.across) < 0.04 && nearest.z > 0.08;
            });
            if (onLeg) {
                ++legs;
                EXPECT_EQ(fabric.labels[fabric.normals.index(x, y)], course & 1) << p.x << ", " << p.y;
            }
        }
    }
    EXPECT_GT(legs, 1000u);
}

double longestEdge(const ClothSheet& sheet)
{
    double longest = 0;
    for (int row = 0; row < sheet.side; ++row) {
        for (int column = 0; column + 1 < sheet.side; ++column) {
            longest = std::max(
                {longest,
                 glm::distance(sheet.places[sheet.index(column, row)], sheet.places[sheet.index(column + 1, row)]),
                 glm::distance(sheet.places[sheet.index(row, column)], sheet.places[sheet.index(row, column + 1)])});
        }
    }
    return longest / sheet.edge;
}

TEST(ClothSheet, HangsFromItsPinsAndHardlyStretches)
{
    ClothSheet sheet = makeSheet(17, 1, [](double u, double v) { return glm::dvec3(u, v, 0); });
    sheet.pinned[sheet.index(0, 16)] = sheet.pinned[sheet.index(16, 16)] = 1;
    settle(sheet, {}, 2000);
    EXPECT_EQ(sheet.places[sheet.index(0, 16)], glm::dvec3(0, 1, 0));
    EXPECT_EQ(sheet.places[sheet.index(16, 16)], glm::dvec3(1, 1, 0));
    EXPECT_LT(sheet.places[sheet.index(8, 16)].y, 1.0) << "the hem sags";
    EXPECT_LT(longestEdge(sheet), 1.1); // one sweep a step leaves threads a little slack
    const ClothSheet fine = refinedSheet(sheet);
    EXPECT_EQ(fine.side, 33);
    EXPECT_EQ(fine.places[fine.index(16, 32)], sheet.places[sheet.index(8, 16)]);
    EXPECT_EQ(std::count(fine.pinned.begin(), fine.pinned.end(), 1), 2);
}

TEST(ClothSheet, StaysOutsideOfASolid)
{
    ClothSheet sheet = makeSheet(17, 2, [](double u, double v) { return glm::dvec3(2 * u - 1, 0.6, 2 * v - 1); });
    ClothForces forces;
    forces.keepOutside = [](glm::dvec3& p) {
        const bool inside = glm::length(p) < 0.5;
        p = inside ? 0.5 * glm::normalize(p) : p;
        return inside;
    };
    settle(sheet, forces, 2000);
    for (const glm::dvec3& place : sheet.places) {
        EXPECT_GT(glm::length(place), 0.5 - 1e-9);
    }
    EXPECT_NEAR(sheet.places[sheet.index(8, 8)].y, 0.5, 0.05) << "it lies on the ball's top";
    EXPECT_LT(sheet.places[sheet.index(0, 0)].y, 0.0) << "its corners hang";
}

TEST(StrokeLetters, AllCapitalsAndDigitsAreDrawnWithinTheirBoxes)
{
    for (const char letter : std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")) {
        ASSERT_TRUE(hasGlyph(letter)) << letter;
        const Glyph glyph = glyphOf(letter);
        ASSERT_FALSE(glyph.strokes.empty()) << letter;
        double highest = 0;
        for (const Stroke& stroke : glyph.strokes) {
            ASSERT_GE(stroke.size(), 2u) << letter;
            for (const glm::dvec2& p : stroke) {
                // Round letters may overshoot, and Q has a tail.
                EXPECT_GE(p.x, -0.06) << letter;
                EXPECT_LE(p.x, glyph.width + 0.06) << letter;
                EXPECT_GE(p.y, -0.08) << letter;
                EXPECT_LE(p.y, 1.02) << letter;
                highest = std::max(highest, p.y);
            }
        }
        EXPECT_NEAR(highest, 1.0, 0.03) << letter;
    }
    EXPECT_FALSE(hasGlyph('%'));
    EXPECT_EQ(glyphOf('a').width, glyphOf('A').width);
}

TEST(StrokeLetters, DistanceIsToTheNearestPointOfTheStroke)
{
    const Stroke bent = {{0, 0}, {1, 0}, {1, 1}};
    EXPECT_DOUBLE_EQ(distanceToStroke({0.5, 0.25}, bent), 0.25);
    EXPECT_DOUBLE_EQ(distanceToStroke({1.3, 1.4}, bent), 0.5);
    EXPECT_DOUBLE_EQ(distanceToStroke({1, 0.5}, bent), 0.0);
}

} // namespace
} // namespace nacre
