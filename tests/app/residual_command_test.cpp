// nacre render, view and info of a surface that acquire gave a residual layer.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "engine/files/whole_file.h"
#include "engine/surface/surface.h"
#include "shared/shading.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

class ResidualCommand : public testing::Test {
protected:
    static void SetUpTestSuite()
    {
        folder_ = new TempFolder;
        const ProgramRun made = runNacre({"synth", path("c"), "--side", "48", "--lights", "10", "--give-lights",
                                          "--material", "ggx:diffuse=0.5,0.2,0.1;specular=0.05;alpha=0.3"});
        ASSERT_EQ(made.exitCode, 0) << made.err;
        for (const char* choice : {"difference", "none"}) {
            const ProgramRun run = runNacre({"acquire", path("c"), "-o", path(std::string(choice) + ".nacre"),
                                             "--normals", "least-squares", "--residual", choice});
            ASSERT_EQ(run.exitCode, 0) << run.err;
        }
    }
    static void TearDownTestSuite() { delete folder_; }

    static std::string path(const std::string& name) { return (*folder_ / name).string(); }

    static ProgramRun render(const std::string& surface, const std::string& output,
                             const std::vector<std::string>& more = {})
    {
        std::vector<std::string> arguments = {"render", path(surface), "--force", "-o", path(output)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }
    static std::vector<float> codes(const std::string& picture) { return loadImage(path(picture)).values; }

    static TempFolder* folder_;
};

TempFolder* ResidualCommand::folder_ = nullptr;

TEST_F(ResidualCommand, OnIsTheDefaultOffTheBrdfAlone)
{
    const ProgramRun automatic = render("difference.nacre", "auto.png", {"--exposure", "0"});
    ASSERT_EQ(automatic.exitCode, 0) << automatic.err;
    EXPECT_EQ(automatic.err.find("residual"), std::string::npos) << automatic.err;
    EXPECT_NE(automatic.out.find("components, on"), std::string::npos) << automatic.out;
    ASSERT_EQ(render("difference.nacre", "on.png", {"--exposure", "0", "--layer", "on"}).exitCode, 0);
    ASSERT_EQ(render("difference.nacre", "off.png", {"--exposure", "0", "--layer", "off"}).exitCode, 0);
    ASSERT_EQ(render("none.nacre", "none.png", {"--exposure", "0", "--layer", "off"}).exitCode, 0);
    EXPECT_EQ(codes("auto.png"), codes("on.png"));
    EXPECT_NE(codes("on.png"), codes("off.png"));
    // Albedo factors in half floats with a layer's pixels, in the same format without: a code of rounding.
    EXPECT_LE(codeDifference(loadImage(path("off.png")), loadImage(path("none.png")), 1).share(), 0.002);
}

// Radiance with the layer is trust times the BRDF's and the layer's sum, which alone is drawn about 0.2140.
TEST_F(ResidualCommand, AloneIsTheSumAboutMiddleGrey)
{
    ASSERT_EQ(render("difference.nacre", "on.exr").exitCode, 0);
    ASSERT_EQ(render("difference.nacre", "off.exr", {"--layer", "off"}).exitCode, 0);
    ASSERT_EQ(
        render("difference.nacre", "alone.png", {"--layer", "alone", "--path", "direct", "--exposure", "0"}).exitCode,
        0);
    const float trust = loadSurface(path("difference.nacre")).residual.trust;
    const std::vector<float> on = codes("on.exr"), off = codes("off.exr"), alone = codes("alone.png");
    size_t tested = 0, wrong = 0;
    for (size_t i = 0; i < on.size(); ++i) {
        if (on[i] > 0) { // neither clamped nor without a normal
            const float expected = srgbFromLinear(0.2140f + on[i] - trust * off[i]);
            wrong += std::abs(alone[i] - std::clamp(expected, 0.0f, 1.0f)) > 1.01f / 255; // a code of rounding
            ++tested;
        }
    }
    EXPECT_GT(tested, 2000u);
    EXPECT_LE(wrong, tested / 500) << "of " << tested; // lookups of 16-bit normals in pictures, of floats in EXR
}

TEST_F(ResidualCommand, AStateFileAndTheWindowSayTheSame)
{
    writeText(*folder_ / "scene.json", R"({"format": "nacre scene", "version": 1, "surface": "difference.nacre",
        "layer": "off", "exposure": 0})");
    ASSERT_EQ(runNacre({"render", "--state", path("scene.json"), "-o", path("state.png")}).exitCode, 0);
    ASSERT_EQ(render("difference.nacre", "off.png", {"--exposure", "0", "--layer", "off"}).exitCode, 0);
    EXPECT_EQ(codes("state.png"), codes("off.png"));
    for (const char* use : {"on", "off", "alone"}) {
        const std::string picture = std::string("view-") + use + ".png";
        const ProgramRun run = runNacre(
            {"view", path("difference.nacre"), "--layer", use, "--exposure", "0", "--headless", "-o", path(picture)});
        ASSERT_EQ(run.exitCode, 0) << run.err;
        ASSERT_EQ(render("difference.nacre", "same.png", {"--exposure", "0", "--layer", use}).exitCode, 0);
        EXPECT_EQ(codes(picture), codes("same.png")) << use;
    }
    EXPECT_NE(readTextFile(*folder_ / "view-off.json").find(R"("layer": "off")"), std::string::npos);
}

TEST_F(ResidualCommand, SaysWhereItIsLeftOutOrFadesOut)
{
    const auto said = [&](const std::vector<std::string>& more) {
        const ProgramRun run = render("difference.nacre", "said.png", more);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        return run.err;
    };
    EXPECT_NE(said({"--view", "0.3,0,1"}).find("residual layer is left out"), std::string::npos);
    EXPECT_NE(said({"--onto", path("none.nacre")}).find("residual layer is left out"), std::string::npos);
    EXPECT_NE(said({"--light", "1,0,-3", "--light", "captured:1"}).find("fades out under 1 of 2 lights"),
              std::string::npos);
    EXPECT_EQ(said({"--view", "0.3,0,1", "--layer", "off"}).find("residual"), std::string::npos);
    EXPECT_EQ(said({"--view", "0.3,0,1", "--quiet"}), "");
}

TEST_F(ResidualCommand, WhatCannotBeIsAUsageError)
{
    const auto refused = [](const ProgramRun& run, const std::string& fragment) {
        EXPECT_EQ(run.exitCode, 2);
        EXPECT_NE(run.err.find(fragment), std::string::npos) << run.err;
    };
    refused(render("difference.nacre", "no.png", {"--layer", "half"}), "layer half is not known; on, off");
    refused(render("none.nacre", "no.png", {"--layer", "alone"}), "has no residual layer");
    refused(render("difference.nacre", "no.png", {"--layer", "alone", "--onto", path("none.nacre")}),
            "has no residual layer");
    refused(render("difference.nacre", "no.png", {"--layer", "alone", "--view", "0.3,0,1"}), "from the front");
    refused(render("difference.nacre", "no.exr", {"--layer", "alone"}), "is radiance");
    refused(runNacre({"view", path("none.nacre"), "--layer", "alone", "--headless", "-o", path("no.png")}),
            "has no residual layer");
    EXPECT_FALSE(std::filesystem::exists(path("no.png")));
}

TEST_F(ResidualCommand, InfoTellsOfTheLayer)
{
    const ProgramRun with = runNacre({"info", path("difference.nacre")}),
                     without = runNacre({"info", path("none.nacre")});
    EXPECT_NE(with.out.find("residual  "), std::string::npos) << with.out;
    EXPECT_NE(with.out.find("of 10 lights"), std::string::npos) << with.out;
    EXPECT_EQ(without.out.find("residual  "), std::string::npos) << without.out;
}

} // namespace
} // namespace nacre::test
