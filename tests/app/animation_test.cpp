// Animated WebP: the frames of the numbered pictures, byte for byte, read back by the format's own library.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <webp/demux.h>

#include "engine/files/animation_file.h"
#include "engine/files/whole_file.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_error.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

struct DecodedAnimation {
    std::vector<Image> frames;
    std::vector<int> ends; // milliseconds
    uint32_t loops = 1;
};

DecodedAnimation decode(const fs::path& file)
{
    const std::string bytes = readWholeFile(file, "an animation");
    const WebPData data{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
    DecodedAnimation decoded;
    WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
    WebPAnimInfo info;
    if (decoder == nullptr || !WebPAnimDecoderGetInfo(decoder, &info)) {
        ADD_FAILURE() << file << " is no animation";
        WebPAnimDecoderDelete(decoder);
        return decoded;
    }
    decoded.loops = info.loop_count;
    while (WebPAnimDecoderHasMoreFrames(decoder)) {
        uint8_t* rgba = nullptr;
        int end = 0;
        EXPECT_TRUE(WebPAnimDecoderGetNext(decoder, &rgba, &end));
        Image frame(static_cast<int>(info.canvas_width), static_cast<int>(info.canvas_height), 3);
        for (size_t i = 0; i < frame.pixelCount(); ++i) {
            for (size_t c = 0; c < 3; ++c) {
                frame.values[3 * i + c] = static_cast<float>(rgba[4 * i + c]) / 255.0f;
            }
        }
        decoded.frames.push_back(std::move(frame));
        decoded.ends.push_back(end);
    }
    WebPAnimDecoderDelete(decoder);
    return decoded;
}

// 8-bit codes: readers turn them into floats each in its own way.
std::vector<int> codes(const Image& picture)
{
    std::vector<int> found(picture.values.size());
    std::transform(picture.values.begin(), picture.values.end(), found.begin(),
                   [](float value) { return static_cast<int>(std::lround(255 * value)); });
    return found;
}

class AnimationTest : public testing::Test {
protected:
    AnimationTest() { saveSurface(folder_ / "s.nacre", glossyScene(61, 40).surface, false); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    ProgramRun render(const std::string& output, std::vector<std::string> more, const std::string& environment = "")
    {
        std::vector<std::string> arguments = {"render", path("s.nacre"), "--light", "0.6,0,0.8",
                                              "-o",     path(output),    "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments, environment);
    }

    void expectRefusal(const ProgramRun& run, int exitCode, const std::string& fragment)
    {
        expectOneLine(run, exitCode, {fragment});
        for (const auto& entry : fs::directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            EXPECT_TRUE(name.find("new") == std::string::npos && name.find(".part") == std::string::npos) << name;
        }
    }

    TempFolder folder_;
};

TEST_F(AnimationTest, HoldsTheNumberedPictures)
{
    ASSERT_EQ(render("turn.webp", {"--frames", "6"}).exitCode, 0);
    ASSERT_EQ(render("turn.png", {"--frames", "6"}).exitCode, 0);
    const DecodedAnimation found = decode(path("turn.webp"));
    ASSERT_EQ(found.frames.size(), 6u);
    EXPECT_EQ(found.loops, 0u) << "for ever";
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(codes(found.frames[i]), codes(loadImage(path("turn_000" + std::to_string(i + 1) + ".png")))) << i;
        EXPECT_EQ(found.ends[i], (i + 1) * AnimationFile::kFrameMilliseconds);
    }
    ASSERT_EQ(render("again.webp", {"--frames", "6"}).exitCode, 0);
    EXPECT_EQ(readWholeFile(path("again.webp"), ""), readWholeFile(path("turn.webp"), ""));
}

TEST_F(AnimationTest, FalseColoursMoveToo)
{
    ASSERT_EQ(render("h.webp", {"--frames", "3", "--show", "theta-h"}).exitCode, 0);
    const DecodedAnimation found = decode(path("h.webp"));
    ASSERT_EQ(found.frames.size(), 3u);
    EXPECT_NE(found.frames[0].values, found.frames[1].values);
}

TEST_F(AnimationTest, WhatDoesNotMoveIsAStillPicture)
{
    ASSERT_EQ(render("one.png", {}).exitCode, 0);
    ASSERT_EQ(render("one.webp", {}).exitCode, 0);
    ASSERT_EQ(render("still.webp", {"--frames", "3", "--motion", "none"}).exitCode, 0);
    for (const char* file : {"one.webp", "still.webp"}) {
        const DecodedAnimation found = decode(path(file));
        ASSERT_EQ(found.frames.size(), 1u);
        EXPECT_EQ(codes(found.frames[0]), codes(loadImage(path("one.png"))));
    }
}

TEST_F(AnimationTest, WhatCannotBeWrittenIsRefused)
{
    expectError([] { AnimationFile("a.webp", 16384, 1); }, {"a.webp", "16384 x 1", "1 to 16383"});
    expectError([] { AnimationFile("a.webp", 5, 0); }, {"5 x 0"});
    EXPECT_NO_THROW(AnimationFile("a.webp", 16383, 1));
    expectRefusal(render("new.webp", {"--size", "16384x1"}), 3, "1 to 16383");
    expectRefusal(render("missing/new.webp", {}), 3, "its folder does not exist");
    // A limit on the size of files stands for a full disk: one block of 512 bytes.
    expectRefusal(render("new.webp", {"--frames", "4"}, "trap '' XFSZ; ulimit -f 1;"), 3, "cannot be written");
    writeText(folder_ / "old.webp", "precious");
    expectRefusal(render("old.webp", {}), 3, "--force");
    expectRefusal(render("old.webp", {"--force", "--frames", "4"}, "trap '' XFSZ; ulimit -f 1;"), 3,
                  "cannot be written");
    EXPECT_EQ(fs::file_size(path("old.webp")), 8u);
}

} // namespace
} // namespace nacre::test
