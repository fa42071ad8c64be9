// What the program says of data and command lines that it cannot use, and with which exit code.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "engine/files/image.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"
#include "tests/support/write_capture.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

// One line on stderr that holds every fragment; a stack or a second line is as wrong as another exit code.
class BadInputTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    // Both commands have to refuse the capture, with nothing written.
    void expectCaptureRefused(const std::vector<std::string>& fragments, std::vector<std::string> more = {})
    {
        for (const auto& [command, output] : {std::pair("acquire", "new.nacre"), std::pair("normals", "new.exr")}) {
            SCOPED_TRACE(command);
            std::vector<std::string> arguments = {command, path("capture"), "-o", path(output)};
            arguments.insert(arguments.end(), more.begin(), more.end());
            expectOneLine(runNacre(arguments), 3, fragments);
            expectNothingWritten();
        }
    }

    void expectNothingWritten() const
    {
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            EXPECT_TRUE(name.find("new") == std::string::npos && name.find(".part") == std::string::npos) << name;
        }
    }

    // A sphere of the radius 26 about the middle of 64x64 pixels, its mask, and `count` photographs of it: dark, with
    // a white spot of the radius 3 about (spotX, spotY), or without one where spotX is negative.
    void writeMirror(int count, int spotX, int spotY, bool cutCorner = false)
    {
        constexpr int kSize = 64;
        Image mask(kSize, kSize, 1), photograph(kSize, kSize, 3);
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const auto within = [&](int cx, int cy, int radius) {
                    return (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius;
                };
                const bool spot = spotX >= 0 && within(spotX, spotY, 3);
                mask.at(x, y) = within(32, 32, 26) && !(cutCorner && x > 30 && y > 30);
                photograph.setRgb(x, y, glm::vec3(spot ? 1.0f : 0.05f));
            }
        }
        writePicture(folder_ / "mirror/mirror.mask.png", mask);
        for (int i = 0; i < count; ++i) {
            writePicture(folder_ / ("mirror/mirror." + std::to_string(i) + ".png"), photograph);
        }
    }

    std::vector<std::string> mirror() const { return {"--mirror-sphere", path("mirror")}; }

    TempFolder folder_;
};

TEST_F(BadInputTest, MissingFolder)
{
    expectCaptureRefused({path("capture"), "does not exist", "folder of a capture"});
    expectOneLine(runNacre({"info", path("capture")}), 3, {path("capture"), "does not exist"});
    expectOneLine(runNacre({"render", path("no.nacre"), "-o", path("new.png")}), 3, {"no.nacre", "is not a surface"});
}

TEST_F(BadInputTest, FolderWithoutACapture)
{
    writeText(folder_ / "capture/readme.txt", "nothing");
    expectCaptureRefused({path("capture"), "holds no capture", "capture.json"});
}

TEST_F(BadInputTest, TruncatedPhotograph)
{
    writeUwFolder(folder_ / "capture", "capture", 4);
    writeText(folder_ / "rig.txt", directionLines(4));
    fs::resize_file(folder_ / "capture/capture.2.tga", 100); // pixels end at 162 bytes, a thumbnail follows
    expectCaptureRefused({"capture.2.tga", "cannot be read"}, {"--rig", path("rig.txt")});
}

// libpng writes a line of its own in front of ours.
TEST_F(BadInputTest, TruncatedPng)
{
    writeDiligentFolder(folder_ / "capture", 5);
    fs::resize_file(folder_ / "capture/003.png", fs::file_size(folder_ / "capture/003.png") / 2);
    const ProgramRun run = runNacre({"acquire", path("capture"), "-o", path("new.nacre")});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_NE(run.err.find("nacre: " + path("capture/003.png") + ": cannot be read to its end"), std::string::npos)
        << run.err;
    expectNothingWritten();
}

TEST_F(BadInputTest, FileThatIsNoPicture)
{
    writeDiligentFolder(folder_ / "capture", 5);
    writeText(folder_ / "capture/003.png", "no picture at all");
    expectCaptureRefused({"003.png", "cannot be read"});
}

TEST_F(BadInputTest, PhotographOfAnotherSize)
{
    writeDiligentFolder(folder_ / "capture", 5);
    writePicture(folder_ / "capture/004.png", testPicture(4, 10, 7));
    expectCaptureRefused({"004.png", "10", "7", "8", "6"});
}

TEST_F(BadInputTest, CountsOfLightsAndPhotographsDiffer)
{
    writeDiligentFolder(folder_ / "capture", 5);
    writeText(folder_ / "capture/light_directions.txt", directionLines(4));
    writeText(folder_ / "capture/light_intensities.txt", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n");
    expectCaptureRefused({"light_directions.txt", "4 lights", "5 photographs"});
}

TEST_F(BadInputTest, CountsOfSphereAndObjectDiffer)
{
    writeUwFolder(folder_ / "capture", "capture", 5);
    writeMirror(4, 40, 25);
    expectCaptureRefused({path("mirror"), "has 4 photographs of a sphere", "has 5"}, mirror());
}

TEST_F(BadInputTest, EmptyMask)
{
    writeDiligentFolder(folder_ / "capture", 5);
    writeMask(folder_ / "capture/mask.png", kTestWidth);
    expectCaptureRefused({"mask.png", "is an empty mask"});
}

TEST_F(BadInputTest, SphereMaskThatIsNoDisc)
{
    writeUwFolder(folder_ / "capture", "capture", 4);
    writeMirror(4, 25, 25, true);
    expectCaptureRefused({"mirror.mask.png", "is no disc"}, mirror());
}

TEST_F(BadInputTest, MissingHighlight)
{
    writeUwFolder(folder_ / "capture", "capture", 4);
    writeMirror(4, -1, -1);
    expectCaptureRefused({"mirror.0.png", "shows no highlight"}, mirror());
}

TEST_F(BadInputTest, HighlightCutByTheMask)
{
    writeUwFolder(folder_ / "capture", "capture", 4);
    writeMirror(4, 32 + 25, 32);
    expectCaptureRefused({"mirror.0.png", "is cut by the sphere's outline or the frame"}, mirror());
}

// The sphere reaches beyond the picture's left side, and so does the highlight.
TEST_F(BadInputTest, HighlightCutByTheFrame)
{
    writeUwFolder(folder_ / "capture", "capture", 4);
    writeMirror(4, 12, 32);
    for (const auto& entry : fs::directory_iterator(folder_ / "mirror")) {
        const Image whole = loadImage(entry.path());
        Image cropped(whole.width - 12, whole.height, whole.channels);
        for (int y = 0; y < cropped.height; ++y) {
            std::copy_n(whole.values.begin() + whole.index(12, y), cropped.width * cropped.channels,
                        cropped.values.begin() + cropped.index(0, y));
        }
        saveImage(entry.path(), cropped, PixelType::uint16);
    }
    expectCaptureRefused({"mirror.0.png", "is cut by the sphere's outline or the frame"}, mirror());
}

TEST_F(BadInputTest, FewerThanThreeLights)
{
    writeDiligentFolder(folder_ / "capture", 2);
    expectCaptureRefused({"has 2 photographs", "at least 3"});
}

TEST_F(BadInputTest, LightsInOnePlane)
{
    writeDiligentFolder(folder_ / "capture", 4);
    writeText(folder_ / "capture/light_directions.txt", "-0.6 0 0.8\n0 0 1\n0.6 0 0.8\n0.28 0 0.96\n");
    expectCaptureRefused({path("capture"), "in one plane", "condition number"});
}

TEST_F(BadInputTest, NanInAFloatPicture)
{
    writeDiligentFolder(folder_ / "capture", 4);
    std::string names;
    for (int i = 1; i <= 4; ++i) {
        Image picture = testPicture(i);
        if (i == 3) {
            picture.setRgb(5, 2, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
        }
        const std::string name = std::to_string(i) + ".exr";
        writePicture(folder_ / "capture" / name, picture);
        names += name + "\n";
    }
    writeText(folder_ / "capture/filenames.txt", names);
    expectCaptureRefused({"3.exr", "is not finite at pixel (5, 2)"});
}

class OutputTest : public BadInputTest {
protected:
    OutputTest()
    {
        EXPECT_EQ(runNacre({"synth", path("capture"), "--side", "48", "--sphere-size", "64", "--lights", "6"}).exitCode,
                  0);
    }

    // The command that writes `output`.
    std::vector<std::string> writing(const std::string& command, const std::string& output) const
    {
        const std::string input = command == "render" ? "s.nacre" : "capture";
        std::vector<std::string> arguments = {command, path(input), "-o", path(output)};
        if (command != "render") {
            arguments.insert(arguments.end(), {"--normals", "least-squares"});
        }
        return arguments;
    }

    void writeSurface() { saveSurface(folder_ / "s.nacre", glossyScene(120, 90).surface, false); }
};

TEST_F(OutputTest, AnOutputThatExistsIsReplacedWithForceAlone)
{
    writeSurface();
    for (const auto& [command, output] : {std::pair("normals", "old.exr"), std::pair("render", "old.png")}) {
        SCOPED_TRACE(command);
        writeText(folder_ / output, "precious");
        std::vector<std::string> arguments = writing(command, output);
        expectOneLine(runNacre(arguments), 3, {path(output), "exists already", "--force"});
        EXPECT_EQ(fs::file_size(folder_ / output), 8u);
        arguments.push_back("--force");
        EXPECT_EQ(runNacre(arguments).exitCode, 0);
        EXPECT_GT(fs::file_size(folder_ / output), 8u);
    }
    writeText(folder_ / "old.nacre", "precious");
    std::vector<std::string> acquiring = writing("acquire", "old.nacre");
    expectOneLine(runNacre(acquiring), 3, {path("old.nacre"), "exists already", "--force"});
    acquiring.push_back("--force"); // which replaces folders by folders
    expectOneLine(runNacre(acquiring), 3, {path("old.nacre"), "is no folder"});
    EXPECT_EQ(fs::file_size(folder_ / "old.nacre"), 8u);
    expectOneLine(runNacre({"synth", path("capture")}), 3, {path("capture"), "exists already", "--force"});
    expectOneLine(runNacre({"demo", "-o", path("capture")}), 3, {path("capture"), "exists already", "--force"});
}

TEST_F(OutputTest, AFolderThatIsNoCaptureIsNeverReplacedBySynth)
{
    writeText(folder_ / "letters/love.txt", "precious");
    EXPECT_EQ(runNacre({"synth", path("letters"), "--force"}).exitCode, 3);
    EXPECT_TRUE(fs::exists(folder_ / "letters/love.txt"));
}

TEST_F(OutputTest, PlacesThatCannotBeWrittenAreRefusedBeforeTheWork)
{
    expectOneLine(runNacre({"acquire", path("capture"), "-o", path("none/new.nacre")}), 3,
                  {"its folder does not exist"});
    expectOneLine(runNacre({"acquire", path("capture"), "-o", path("new.nacre"), "--json", path("none/a.json")}), 3,
                  {"none/a.json", "its folder does not exist"});
    expectOneLine(runNacre({"normals", path("capture"), "-o", path("new.exr"), "--json", path("none/a.json")}), 3,
                  {"none/a.json", "its folder does not exist"});
    expectNothingWritten();
}

TEST_F(OutputTest, NoVulkanDevice)
{
    writeSurface();
    const std::string none = "VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent";
    expectOneLine(runNacre(writing("render", "new.png"), none), 3, {"no Vulkan device", "install a driver"});
    expectNothingWritten();
    // Photographs become a surface without one.
    EXPECT_EQ(runNacre(writing("acquire", "other.nacre"), none).exitCode, 0);
}

// A limit on the size of files stands for a full disk: the write fails with an error where SIGXFSZ is ignored. dash
// counts `ulimit -f` in blocks of 512 bytes; every output below is larger than 4096 bytes.
TEST_F(OutputTest, AFullDiskLeavesNothingBehind)
{
    writeSurface();
    const std::string full = "trap '' XFSZ; ulimit -f 8;";
    for (const auto& [command, output] :
         {std::pair("acquire", "new.nacre"), std::pair("normals", "new.exr"), std::pair("normals", "new.png"),
          std::pair("render", "new.png"), std::pair("render", "new.exr")}) {
        SCOPED_TRACE(std::string(command) + " " + output);
        std::vector<std::string> arguments = writing(command, output);
        arguments.push_back("--quiet");
        // acquire names the file within the surface's folder
        expectOneLine(runNacre(arguments, full), 3,
                      {output == std::string("new.nacre") ? "normals.exr" : output, "cannot be written"});
        expectNothingWritten();
    }
    EXPECT_EQ(runNacre({"synth", path("new"), "--side", "48"}, full).exitCode, 3);
    expectNothingWritten();
}

// What was there stays as it was where its replacement does not fit.
TEST_F(OutputTest, AFullDiskKeepsTheOldOutput)
{
    writeText(folder_ / "old.exr", "precious");
    std::vector<std::string> arguments = writing("normals", "old.exr");
    arguments.push_back("--force");
    expectOneLine(runNacre(arguments, "trap '' XFSZ; ulimit -f 8;"), 3, {"old.exr", "cannot be written"});
    EXPECT_EQ(fs::file_size(folder_ / "old.exr"), 8u);
}

TEST_F(BadInputTest, UsageErrorsAreOneLineThatNamesTheHelp)
{
    const std::pair<std::vector<std::string>, std::vector<std::string>> cases[] = {
        {{}, {"no command", "nacre --help"}},
        {{"bogus"}, {"'bogus' is no command", "nacre --help"}},
        {{"--bogus"}, {"'--bogus'", "nacre --help"}},
        {{"render"}, {"--output is required", "nacre render --help"}},
        {{"render", "s.nacre"}, {"--output is required", "nacre render --help"}},
        {{"render", "s.nacre", "-o", "x.png", "--bogus"}, {"--bogus", "nacre render --help"}},
        {{"render", "s.nacre", "-o", "x.png", "--exposure", "abc"}, {"--exposure = abc", "nacre render --help"}},
        {{"render", "s.nacre", "-o", "x.png", "--light"}, {"--light", "nacre render --help"}},
        {{"render", "s.nacre", "-o", "x.png", "--normal-y", "dx"}, {"normal-y", "put the material onto"}},
        {{"render", "s.nacre", "-o", "x.jpg"}, {"x.jpg", ".png"}},
        {{"acquire", "c", "-o", "x.nacre", "--threads", "many"}, {"--threads = many", "nacre acquire --help"}},
        {{"acquire", "c", "-o", "x.nacre", "--threads=-1"}, {"--threads -1", "1 or more"}},
        {{"acquire", "c", "-o", "x"}, {"NAME.nacre"}},
        {{"acquire", "c", "-o", "x.nacre", "--normals", "guess"}, {"guess", "least-squares"}},
        {{"normals", "c", "-o", "x.jpg"}, {"x.jpg", ".exr"}},
        {{"normals", "c", "-o", "x.exr", "--field-of-view", "121"}, {"--field-of-view 121", "120 at most"}},
        {{"normals", "c", "-o", "x.exr", "--field-of-view", "0"}, {"--field-of-view 0", "above 0"}},
        {{"normals", "c", "-o", "x.exr", "--light-distance", "near"}, {"--light-distance near", "far or auto"}},
        {{"normals", "c", "-o", "x.exr", "--light-distance=-2"}, {"--light-distance -2", "above 0"}},
        {{"normals", "c", "-o", "x.exr", "--object-width", "0"}, {"--object-width 0", "above 0"}},
        {{"normals", "c", "-o", "x.exr", "--object-width", "2", "--light-distance", "3"},
         {"--object-width and --light-distance 3", "one of them"}},
        {{"acquire", "c", "-o", "x.nacre", "--interpolation", "cubic"}, {"cubic", "local-linear or paper"}},
        {{"acquire", "c", "-o", "x.nacre", "--k", "many"}, {"--k many", "auto"}},
        {{"acquire", "c", "-o", "x.nacre", "--tolerance", "good"}, {"--tolerance good", "45dB"}},
        {{"acquire", "c", "-o", "x.nacre", "--budget-bytes", "3X"}, {"--budget-bytes 3X", "64KiB"}},
        {{"acquire", "c", "-o", "x.nacre", "--range", "all"}, {"range all", "captured, front or full"}},
        {{"evaluate", "c", "--hold-out", "every:1"}, {"every:1", "N from 2"}},
        {{"compare", "a.png"}, {"REFERENCE is required", "nacre compare --help"}},
        {{"synth", "x", "--shape", "cube"}, {"--shape cube", "bumpy, bowl or sphere"}},
        {{"synth", "x", "--format", "jpg"}, {"--format jpg", "png or exr"}},
        {{"synth", "x", "--threads=-1"}, {"--threads -1", "1 or more"}},
        {{"demo", "--threads=-1"}, {"--threads -1", "1 or more"}},
        {{"info", "a", "b"}, {"b", "nacre info --help"}},
    };
    for (const auto& [arguments, fragments] : cases) {
        SCOPED_TRACE(arguments.empty() ? "nothing" : arguments.front() + " ... " + arguments.back());
        expectOneLine(runNacre(arguments), 2, fragments);
    }
}

TEST_F(BadInputTest, HelpIsNoError)
{
    for (const char* command : {"acquire", "normals", "calibrate", "render", "compare", "synth", "demo", "info"}) {
        SCOPED_TRACE(command);
        const ProgramRun run = runNacre({command, "--help"});
        EXPECT_EQ(run.exitCode, 0);
        EXPECT_EQ(run.err, "");
        EXPECT_NE(run.out.find("Example"), std::string::npos) << run.out;
    }
    EXPECT_EQ(runNacre({"--version"}).exitCode, 0);
}

} // namespace
} // namespace nacre::test
