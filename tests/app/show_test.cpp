// nacre render --show, and what it says of uncertain pictures.
#include <algorithm>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/scene/false_colour.h"
#include "tests/gpu/scenes.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

class ShowTest : public testing::Test {
protected:
    ShowTest()
    {
        scene_ = glossyScene(60, 40);
        saveSurface(folder_ / "s.nacre", scene_.surface, false);
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    ProgramRun render(const std::string& output, std::vector<std::string> more)
    {
        std::vector<std::string> arguments = {"render", path("s.nacre"), "-o", path(output)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }

    TempFolder folder_;
    Scene scene_;
};

TEST_F(ShowTest, EveryViewIsItsTwin)
{
    scene_.lights = {{glm::normalize(glm::vec3(0.5f, 0, 1)), glm::vec3(1)}};
    const std::pair<const char*, Show> views[] = {
        {"normals", Show::normals}, {"labels", Show::labels}, {"theta-h", Show::thetaH}, {"theta-d", Show::thetaD}};
    for (const auto& [name, show] : views) {
        SCOPED_TRACE(name);
        const ProgramRun run = render(std::string(name) + ".png", {"--show", name, "--light", "0.5,0,1"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
        EXPECT_EQ(run.out.find("exposure"), std::string::npos) << run.out;
        const Image picture = loadImage(path(std::string(name) + ".png"));
        const Image twin = referenceFalseColour(scene_, show, {});
        size_t off = 0;
        for (size_t i = 0; i < twin.values.size(); ++i) {
            off += std::abs(picture.values[i] - twin.values[i]) > 1.01f / 255;
        }
        EXPECT_LE(off, 15u) << "but for five pixels of the rim";
    }
}

TEST_F(ShowTest, AStateFileShowsToo)
{
    writeText(folder_ / "scene.json",
              R"({"format": "nacre scene", "version": 1, "surface": "s.nacre", "show": "normals"})");
    ASSERT_EQ(runNacre({"render", "--state", path("scene.json"), "-o", path("a.png")}).exitCode, 0);
    ASSERT_EQ(render("b.png", {"--show", "normals"}).exitCode, 0);
    EXPECT_EQ(loadImage(path("a.png")).values, loadImage(path("b.png")).values);
}

TEST_F(ShowTest, BadViewsAreUsageErrors)
{
    const ProgramRun unknown = render("new.png", {"--show", "depth"}),
                     radiance = render("new.exr", {"--show", "labels"});
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("show depth is not known; picture, normals"), std::string::npos) << unknown.err;
    EXPECT_EQ(radiance.exitCode, 2);
    EXPECT_NE(radiance.err.find("no false colours"), std::string::npos) << radiance.err;
}

// The table spans lights up to 90 degrees from the view.
TEST_F(ShowTest, SaysWhatShareIsUncertain)
{
    const ProgramRun within = render("a.png", {"--light", "0.5,0,1"});
    EXPECT_EQ(within.err, "");
    const ProgramRun side = render("b.png", {"--light", "1,0,0.1", "--view=-1,0,0.5"});
    EXPECT_NE(side.err.find("100.0 % of this picture is uncertain by more than 20 %"), std::string::npos) << side.err;
    EXPECT_EQ(std::count(side.err.begin(), side.err.end(), '\n'), 1);
    const ProgramRun transferred =
        render("c.png", {"--onto", path("s.nacre"), "--light", "1,0,-0.2", "--light", "0,0,1"});
    EXPECT_EQ(transferred.exitCode, 0);
    EXPECT_NE(transferred.err.find("--show coverage marks it"), std::string::npos) << transferred.err;
    EXPECT_EQ(render("d.png", {"--light", "1,0,-0.2", "--quiet"}).err, "");
}

} // namespace
} // namespace nacre::test
