// Outputs that cannot be written, photographs that cannot be meant, and --intensities, as the program's users see them.
#include <algorithm>
#include <fstream>

#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "tests/support/run_nacre.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;

class Destinations : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TempFolder;
        const ProgramRun run = runNacre({"synth", path("c"), "--shape", "sphere", "--side", "48", "--sphere-size", "64",
                                         "--lights", "9", "--give-lights"});
        ASSERT_EQ(run.exitCode, 0) << run.err;
    }
    static void TearDownTestSuite()
    {
        delete folder_;
        folder_ = nullptr;
    }
    static std::string path(const std::string& name) { return (*folder_ / name).string(); }
    static ProgramRun normals(std::vector<std::string> more, const std::string& capture = "c")
    {
        std::vector<std::string> all = {"normals", path(capture), "-o", path("n.exr"), "--normals", "least-squares"};
        all.insert(all.end(), more.begin(), more.end());
        return runNacre(all);
    }
    static void expectRefused(const ProgramRun& run, const std::vector<std::string>& fragments)
    {
        EXPECT_EQ(run.exitCode, 3) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        for (const std::string& fragment : fragments) {
            EXPECT_NE(run.err.find(fragment), std::string::npos) << fragment << " is not in: " << run.err;
        }
        EXPECT_FALSE(fs::exists(path("n.exr")));
    }

    static TempFolder* folder_;
};

TempFolder* Destinations::folder_ = nullptr;

TEST_F(Destinations, AreCheckedBeforeTheWork)
{
    std::ofstream(path("file")) << "text";
    fs::create_directories(path("folder"));
    expectRefused(normals({"--debug-dir", path("file")}), {"file", "is no folder"});
    expectRefused(normals({"--debug-dir", path("file/below")}), {"below", "a file"});
    expectRefused(normals({"--json", path("folder")}), {"folder", "is a folder"});
    expectRefused(normals({"--json", path("nowhere/x.json")}), {"x.json", "its folder does not exist"});
}

TEST_F(Destinations, IntensitiesGivenAreTakenAsTheyAre)
{
    fs::copy(path("c"), path("dim"), fs::copy_options::recursive);
    const fs::path dimmed = path("dim/object_05.png");
    Image image = loadImage(dimmed);
    for (float& value : image.values) {
        value *= 0.7f;
    }
    saveImage(dimmed, image, PixelType::uint16);
    const ProgramRun automatic = normals({"--force"}, "dim");
    EXPECT_NE(automatic.out.find("were corrected: object_05.png"), std::string::npos) << automatic.out << automatic.err;
    const ProgramRun given = normals({"--force", "--intensities", "given"}, "dim");
    EXPECT_EQ(given.exitCode, 0) << given.err;
    EXPECT_EQ(given.out.find("corrected"), std::string::npos) << given.out;
    EXPECT_EQ(normals({"--intensities", "some"}).exitCode, 2);
    EXPECT_EQ(normals({"--self-light", "some"}).exitCode, 2);
    fs::remove(path("n.exr"));
}

TEST_F(Destinations, ACutJpegIsRefusedByName)
{
    writePicture(path("whole.jpg"), testPicture(1, 64, 64));
    fs::copy_file(path("whole.jpg"), path("cut.jpg"));
    EXPECT_EQ(runNacre({"compare", path("whole.jpg"), path("whole.jpg")}).exitCode, 0);
    fs::resize_file(path("cut.jpg"), fs::file_size(path("cut.jpg")) * 3 / 4);
    expectRefused(runNacre({"compare", path("cut.jpg"), path("whole.jpg")}), {"cut.jpg", "is cut off"});
    // Cameras put what they like behind the end.
    std::ofstream(path("whole.jpg"), std::ios::app) << "trailer";
    EXPECT_EQ(runNacre({"compare", path("whole.jpg"), path("whole.jpg")}).exitCode, 0);
}

TEST_F(Destinations, TruthCanBeTheSphereInTheMask)
{
    const ProgramRun run = normals({"--force", "--truth", "sphere"});
    EXPECT_NE(run.out.find("degrees against sphere"), std::string::npos) << run.out << run.err;
    EXPECT_NE(run.out.find("misfit "), std::string::npos);
    fs::remove(path("n.exr"));
}

TEST_F(Destinations, APhotographIsNoNormalMap)
{
    ASSERT_EQ(runNacre({"acquire", path("c"), "-o", path("s.nacre"), "--normals", "least-squares"}).exitCode, 0);
    expectRefused(runNacre({"render", path("s.nacre"), "--onto", path("c/object_01.png"), "-o", path("n.exr")}),
                  {"object_01.png", "is no normal map"});
}

} // namespace
} // namespace nacre
