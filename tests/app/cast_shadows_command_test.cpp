// Surfaces that cast their own shadows: nacre acquire, render and info.
#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "engine/surface/surface.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

std::vector<std::string> synthesise(const std::string& folder, const std::string& shape)
{
    return {"synth",
            folder,
            "--shape",
            shape,
            "--side",
            "96",
            "--lights",
            "24",
            "--give-lights",
            "--material",
            "lambert:0.6,0.5,0.4"};
}

// A solid of bumps shadows itself: photographs left out gain by a height that casts the others' shadows.
TEST(CastShadowsCommand, AreKeptWhereTheyExplainPhotographsAndDrawnByDefault)
{
    const TempFolder folder;
    const auto path = [&](const char* name) { return (folder / name).string(); };
    ASSERT_EQ(runNacre(synthesise(path("c"), "bumpy")).exitCode, 0);
    const ProgramRun run =
        runNacre({"acquire", path("c"), "-o", path("s.nacre"), "--residual", "none", "--normals", "least-squares"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_NE(run.out.find("with the shadows that a height casts"), std::string::npos) << run.out;
    const Surface surface = loadSurface(path("s.nacre"));
    ASSERT_TRUE(surface.castsShadows) << run.out;
    EXPECT_FALSE(surface.height.values.empty());
    const auto draw = [&](const char* to, std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "render", path("s.nacre"), "--light=-1,0.2,0.6", "--path", "direct", "--exposure", "0", "-o", path(to)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramRun drawn = runNacre(arguments);
        EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
        return loadImage(path(to)).values;
    };
    const std::vector<float> own = draw("own.png", {}), asked = draw("asked.png", {"--shadows"}),
                             none = draw("none.png", {"--no-shadows"});
    EXPECT_EQ(own, asked);
    size_t darker = 0, brighter = 0;
    for (size_t i = 0; i < own.size(); ++i) {
        darker += own[i] < none[i];
        brighter += own[i] > none[i];
    }
    EXPECT_GT(darker, 100u);
    EXPECT_EQ(brighter, 0u);
}

TEST(CastShadowsCommand, AConvexObjectHasNone)
{
    const TempFolder folder;
    const std::string capture = (folder / "c").string(), surface = (folder / "s.nacre").string();
    ASSERT_EQ(runNacre(synthesise(capture, "sphere")).exitCode, 0);
    const ProgramRun run = runNacre({"acquire", capture, "-o", surface, "--normals", "least-squares"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_FALSE(loadSurface(surface).castsShadows) << run.out;
    const ProgramRun unknown = runNacre({"acquire", capture, "-o", surface, "--cast-shadows", "some"});
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("auto or off"), std::string::npos) << unknown.err;
}

} // namespace
} // namespace nacre::test
