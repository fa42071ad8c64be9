#include <gtest/gtest.h>

#include "app/arguments/nearest_name.h"

namespace nacre {
namespace {

TEST(NearestName, IsAFewLettersAway)
{
    const std::vector<std::string> names{"--light", "--layer", "--output", "acquire"};
    EXPECT_EQ(nearestName("--ligth", names), "--light");
    EXPECT_EQ(nearestName("--lights", names), "--light");
    EXPECT_EQ(nearestName("aquire", names), "acquire");
    EXPECT_EQ(nearestName("--size", names), "");
    EXPECT_EQ(nearestName("", names), "");
    EXPECT_EQ(nearestName("-o", {"-q"}), "");
}

} // namespace
} // namespace nacre
