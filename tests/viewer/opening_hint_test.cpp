#include <utility>

#include <gtest/gtest.h>

#include "engine/view_state/opening_hint.h"

namespace nacre {
namespace {

// Looks at it as a window does, and answers when it was first gone; no look shows more of it than the one before.
double goneAt(OpeningHint hint, double now, int& looks)
{
    float before = 1;
    while (hint.opacity(now) > 0) {
        EXPECT_LE(hint.opacity(now), before);
        before = hint.opacity(now);
        now += hint.rest(now);
        ++looks;
    }
    return now;
}

TEST(OpeningHint, GoesByItselfAfterAWhile)
{
    const OpeningHint hint;
    EXPECT_EQ(hint.opacity(0), 1);
    EXPECT_EQ(hint.opacity(OpeningHint::kSeconds), 1);
    int looks = 0;
    EXPECT_NEAR(goneAt(hint, 0, looks), OpeningHint::kSeconds + OpeningHint::kFadeSeconds,
                2 * OpeningHint::kStepSeconds);
    EXPECT_LE(looks, 13) << "an idle window hardly draws";
}

TEST(OpeningHint, FadesInFewSteps)
{
    const OpeningHint hint;
    int changes = 0;
    float before = 1;
    for (double now = 0; now < 12; now += 1 / 64.0) {
        changes += std::exchange(before, hint.opacity(now)) != before;
    }
    EXPECT_LE(changes, 10) << "a frame each";
    EXPECT_EQ(before, 0);
}

TEST(OpeningHint, GoesSoonerOnceTheUserHasBegunAndStaysAway)
{
    OpeningHint hint;
    hint.leave(2);
    EXPECT_EQ(hint.opacity(2), 1);
    int looks = 0;
    const double gone = goneAt(hint, 2, looks);
    EXPECT_NEAR(gone, 2 + OpeningHint::kFadeSeconds, 2 * OpeningHint::kStepSeconds);
    hint.leave(gone);
    EXPECT_EQ(hint.opacity(gone), 0);
}

} // namespace
} // namespace nacre
