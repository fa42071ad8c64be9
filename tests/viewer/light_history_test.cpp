#include "engine/view_state/light_history.h"

#include <gtest/gtest.h>

namespace nacre {
namespace {

TEST(LightHistory, GoesBackAndForwardByWholeDrags)
{
    LightHistory history;
    ViewState state;
    std::vector<std::vector<LightSource>> kept;
    for (int drag = 0; drag < 3; ++drag) {
        for (int move = 0; move < 5; ++move) {
            state.lights = {{.direction = {0.1f * static_cast<float>(drag), 0.1f * static_cast<float>(move), 1}}};
            history.follow(state, true);
        }
        history.follow(state, false);
        kept.push_back(state.lights);
    }
    ViewState other = state;
    for (const int drag : {1, 0}) {
        ASSERT_TRUE(history.undo(other));
        EXPECT_EQ(other.lights, kept[drag]);
    }
    EXPECT_FALSE(history.undo(other));
    for (const int drag : {1, 2}) {
        ASSERT_TRUE(history.redo(other));
        EXPECT_EQ(other.lights, kept[drag]);
    }
    EXPECT_FALSE(history.redo(other));
    EXPECT_EQ(other, state);
}

TEST(LightHistory, ForgetsWhatWasUndoneOnceSomethingElseIsDone)
{
    LightHistory history;
    ViewState state;
    for (const char* sky : {"", "a.hdr", "b.hdr"}) {
        state.environment = sky;
        history.follow(state, false);
    }
    ASSERT_TRUE(history.undo(state));
    EXPECT_EQ(state.environment, "a.hdr");
    state.environment = "c.hdr";
    EXPECT_FALSE(history.redo(state)) << "what was not followed yet counts";
    ASSERT_TRUE(history.undo(state));
    EXPECT_EQ(state.environment, "a.hdr");
}

} // namespace
} // namespace nacre
