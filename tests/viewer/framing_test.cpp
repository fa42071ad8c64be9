#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/view_state/framing.h"

namespace nacre {
namespace {

constexpr glm::vec2 kPicture{200, 100};
constexpr Area kArea{{0, 0}, {400, 400}};

TEST(Framing, FittedShowsAllOfThePicture)
{
    const Framing framing = resolved({}, kPicture, kArea);
    EXPECT_FLOAT_EQ(framing.zoom, 2);
    EXPECT_EQ(screenFromPicture({0, 0}, framing, kArea), glm::vec2(0, 100));
    EXPECT_EQ(screenFromPicture(kPicture, framing, kArea), glm::vec2(400, 300));
}

TEST(Framing, ScreenAndPictureAreInverses)
{
    const Framing framing{.zoom = 3.7f, .centre = {31, 64}};
    const glm::vec2 pixel(12.5f, 80.25f);
    EXPECT_LT(glm::distance(pictureFromScreen(screenFromPicture(pixel, framing, kArea), framing, kArea), pixel), 1e-4f);
}

TEST(Framing, TheWheelKeepsWhatIsUnderTheCursor)
{
    const glm::vec2 cursor(250, 180);
    const Framing before = resolved({}, kPicture, kArea), after = zoomed({}, 4, cursor, kPicture, kArea);
    EXPECT_NEAR(after.zoom, 4, 1e-4); // four steps double
    EXPECT_LT(glm::distance(pictureFromScreen(cursor, before, kArea), pictureFromScreen(cursor, after, kArea)), 1e-4f);
    const Framing most = zoomed({}, 1000, cursor, kPicture, kArea);
    EXPECT_LE(most.zoom, 64);
    EXPECT_GT(zoomed({}, -1000, cursor, kPicture, kArea).zoom, 0);
}

TEST(Framing, TheDragTakesThePictureAlong)
{
    const glm::vec2 moved(30, -20), cursor(200, 200);
    const Framing before{.zoom = 4, .centre = {100, 50}}, after = panned(before, moved, kPicture, kArea);
    EXPECT_LT(glm::distance(pictureFromScreen(cursor, before, kArea), pictureFromScreen(cursor + moved, after, kArea)),
              1e-4f);
    EXPECT_EQ(panned(before, {1e6f, 1e6f}, kPicture, kArea).centre, glm::vec2(0)) << "it cannot be lost";
}

void expectTiling(const Framing& framing, const Area& area)
{
    const std::vector<BlitRegion> regions = blitRegions(kPicture, 0, 200, framing, area);
    ASSERT_FALSE(regions.empty());
    for (const BlitRegion& r : regions) {
        EXPECT_LT(r.from.x, r.fromEnd.x);
        EXPECT_GE(r.from.x, 0);
        EXPECT_LE(r.fromEnd.x, 200);
        EXPECT_GE(r.to.x, area.origin.x);
        EXPECT_GE(r.to.y, area.origin.y);
        EXPECT_LE(r.toEnd.x, area.origin.x + area.size.x);
        EXPECT_LE(r.toEnd.y, area.origin.y + area.size.y);
        // A corner lies where its pixel does, unless the border has moved it there.
        const glm::vec2 wanted = screenFromPicture(r.from, framing, area);
        const glm::vec2 shown = glm::clamp(wanted, area.origin, area.origin + area.size);
        EXPECT_LT(glm::distance(glm::vec2(r.to), shown), 0.75f); // rounded to whole pixels both ways
    }
}

TEST(PictureBlit, StaysInTheAreaAndInThePicture)
{
    expectTiling(resolved({}, kPicture, kArea), kArea);
    expectTiling({.zoom = 37.3f, .centre = {13.3f, 70.9f}}, kArea); // single pixels are cut by the border
    expectTiling({.zoom = 0.3f, .centre = {13.3f, 70.9f}}, kArea);
    expectTiling({.zoom = 64, .centre = {0, 0}}, {{50, 60}, {30, 30}}); // less than one pixel
}

TEST(PictureBlit, TheTwoSidesOfAWipeMeet)
{
    const Framing framing{.zoom = 1.7f, .centre = {90, 40}};
    const auto left = blitRegions(kPicture, 0, 77, framing, kArea),
               right = blitRegions(kPicture, 77, 200, framing, kArea);
    ASSERT_FALSE(left.empty());
    ASSERT_FALSE(right.empty());
    EXPECT_EQ(left.back().toEnd.x, right.front().to.x);
    EXPECT_EQ(left.back().fromEnd.x, 77);
}

TEST(PictureBlit, NothingWhereThePictureIsElsewhere)
{
    EXPECT_TRUE(blitRegions(kPicture, 0, 200, {.zoom = 1, .centre = {-1000, 50}}, kArea).empty());
}

} // namespace
} // namespace nacre
