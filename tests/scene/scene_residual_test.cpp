#include "engine/scene/scene_residual.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/residual_surface.h"

namespace nacre {
namespace {

constexpr glm::vec3 kFront(0, 0, 1);

TEST(SceneResidual, AloneNeedsALayerFromTheFront)
{
    Surface surface = residualSurface();
    const glm::vec3 aside = glm::normalize(glm::vec3(0.3f, 0, 1));
    EXPECT_TRUE(hasResidualFrom(surface, kFront));
    EXPECT_FALSE(hasResidualFrom(surface, aside));
    EXPECT_NO_THROW(requireResidual(surface, kFront, ResidualUse::alone));
    expectError([&] { requireResidual(surface, aside, ResidualUse::alone); }, {"layer alone", "from the front"},
                Error::kUsage);
    surface.residual = {};
    expectError([&] { requireResidual(surface, kFront, ResidualUse::alone); }, {"has no residual layer"},
                Error::kUsage);
    EXPECT_NO_THROW(requireResidual(surface, kFront, ResidualUse::off));
    EXPECT_NO_THROW(requireResidual(surface, aside, ResidualUse::on));
}

// The ring's lights stand 40 degrees off the view, some 30 from each other: the layer fades from twice that on.
TEST(SceneResidual, CountsTheLightsThatItFadesOutUnder)
{
    const Surface surface = residualSurface();
    const Light within{glm::normalize(glm::vec3(0.3f, 0.2f, 1)), {1, 1, 1}}, beyond{{0, 0, -1}, {1, 1, 1}},
        off{{0, 0, -1}, {0, 0, 0}};
    EXPECT_EQ(lightsBeyondResidual(surface.residual, std::vector{within, within}), 0u);
    EXPECT_EQ(lightsBeyondResidual(surface.residual, std::vector{within, beyond, off}), 1u);
}

} // namespace
} // namespace nacre
