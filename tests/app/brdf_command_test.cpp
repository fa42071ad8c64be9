// `nacre brdf` and `--material` as their users start them.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/surface.h"
#include "tests/support/data_folder.h"
#include "tests/support/run_nacre.h"

namespace nacre {
namespace {
namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kGlossy = "ggx:diffuse=0.3,0.2,0.1;specular=0.05;alpha=0.2";

class BrdfCommandTest : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    Json report(std::vector<std::string> arguments) const
    {
        arguments.insert(arguments.begin(), "brdf");
        arguments.insert(arguments.end(), {"--quiet", "--force", "--json", path("report.json")});
        const ProgramRun run = runNacre(arguments);
        EXPECT_EQ(run.exitCode, 0) << run.err;
        EXPECT_TRUE(run.out.empty()) << run.out;
        std::ifstream stream(folder_ / "report.json");
        return run.exitCode == 0 ? Json::parse(stream) : Json();
    }

    void expectRefused(const std::vector<std::string>& arguments, int exitCode,
                       const std::vector<std::string>& fragments) const
    {
        const ProgramRun run = runNacre(arguments);
        EXPECT_EQ(run.exitCode, exitCode) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
        for (const std::string& fragment : fragments) {
            EXPECT_NE(run.err.find(fragment), std::string::npos) << "\"" << fragment << "\" is not in: " << run.err;
        }
    }

    TempFolder folder_;
};

TEST_F(BrdfCommandTest, AuditsAModel)
{
    const Json json = report({"lambert:0.6,0.5,0.4"});
    EXPECT_NEAR(json["largestAlbedo"].get<double>(), 0.6, 2e-3);
    EXPECT_EQ(json["negative"], 0);
    EXPECT_LT(json["reciprocity"]["largest"].get<double>(), 1e-6);
    EXPECT_EQ(json["furnace"].size(), 6u);
}

TEST_F(BrdfCommandTest, EveryExportIsTheModelAgain)
{
    report({kGlossy, "--export", path("a.binary"), "--export", path("a.exr"), "--export", path("a.ktx2"), "--export",
            path("a.bsdf")});
    EXPECT_TRUE(fs::exists(folder_ / "a.ktx2"));
    // Texels of one degree: 60 dB straight from the table, a little less through MERL's cells.
    EXPECT_GT(report({path("a.exr"), "--against", kGlossy})["against"]["psnr"].get<double>(), 56);
    EXPECT_GT(report({path("a.binary"), "--against", kGlossy})["against"]["psnr"].get<double>(), 50);
    // Of 18 incident angles by 64 x 64 places, which bilinear lookups join.
    EXPECT_GT(report({path("a.bsdf"), "--against", kGlossy})["against"]["psnr"].get<double>(), 40);
    EXPECT_TRUE(report({path("a.exr"), "--against", "table:" + path("a.exr")})["against"]["psnr"].is_null());
}

TEST_F(BrdfCommandTest, MakesPictures)
{
    EXPECT_EQ(runNacre({"brdf", kGlossy, "-o", path("pictures")}).exitCode, 0);
    for (const char* name : {"slices.png", "sphere.png"}) {
        const Image picture = loadImage(folder_ / "pictures" / name);
        std::vector<float> values = picture.values;
        std::sort(values.begin(), values.end());
        EXPECT_GT(values[values.size() * 99 / 100], 0.8f) << name; // something is bright
        EXPECT_LT(values[values.size() / 20], 0.2f) << name;       // something is dark
    }
    EXPECT_EQ(runNacre({"brdf", kGlossy, "-o", path("pictures")}).exitCode, 3);
    EXPECT_EQ(runNacre({"brdf", kGlossy, "-o", path("pictures"), "--force"}).exitCode, 0);
}

TEST_F(BrdfCommandTest, KnowsTheMaterialsOfASurface)
{
    const BrdfModel lambert = LambertGgx{glm::vec3(0.5f), glm::vec3(0), 0.3f};
    const BrdfTable table = tabulatedBrdf(lambert, {20, 10, 10}, {kHalfDifference, 0.4f});
    saveSurface(folder_ / "s.nacre", transferredSurface(sphereNormalMap(8), {"chalk", table, {}}), false);
    const Json json = report({path("s.nacre"), "--against", "lambert:0.5"});
    EXPECT_TRUE(json["relative"]);
    EXPECT_NEAR(json["table"]["thetaDMaxDegrees"].get<double>(), 0.4 * 180 / M_PI, 1e-3);
    EXPECT_EQ(json["table"]["covered"], 1);
    EXPECT_LT(json["against"]["percentile95RelativeError"].get<double>(), 1e-4);
    expectRefused({"brdf", path("s.nacre") + "#3"}, 2, {"holds no material #3", "#1 (chalk)"});
}

TEST_F(BrdfCommandTest, ReadsTheDatabases)
{
    NACRE_REQUIRE_DATA("measured");
    const fs::path measured = dataFolder() / "measured";
    const Json rgl = report({measured / "paper_white_rgb.bsdf"});
    EXPECT_NEAR(rgl["furnace"][0]["albedo"][1].get<double>(), 0.9, 0.1); // white paper
    EXPECT_GT(rgl["reciprocity"]["median"].get<double>(), 0.005);        // as measured, not folded
    const Json cornell = report({measured / "garnet_red.brdf"});
    EXPECT_EQ(cornell["samples"], 1439);
    EXPECT_GT(cornell["heldOut"]["local-linear"]["all"]["psnr"].get<double>(), 26);
}

TEST_F(BrdfCommandTest, SynthAndRenderTakeFiles)
{
    report({kGlossy, "--export", path("a.binary"), "--export", path("a.exr")});
    EXPECT_EQ(runNacre({"synth", path("c"), "--material", "merl:" + path("a.binary"), "--side", "32", "--lights", "3",
                        "--sphere-size", "64", "--quiet"})
                  .exitCode,
              0);
    saveNormalMap(folder_ / "n.exr", sphereNormalMap(48));
    Image pictures[2];
    const std::string materials[2] = {path("a.exr"), kGlossy};
    for (int i = 0; i < 2; ++i) {
        const ProgramRun run = runNacre({"render", "--material", materials[i], "--onto", path("n.exr"), "--force",
                                         "--light=0.3,0.4,0.8", "-o", path("r.exr")});
        ASSERT_EQ(run.exitCode, 0) << run.err;
        pictures[i] = loadImage(folder_ / "r.exr");
    }
    // The same table, once from its file and once from the model.
    EXPECT_EQ(pictures[0].values, pictures[1].values);
    EXPECT_GT(*std::max_element(pictures[0].values.begin(), pictures[0].values.end()), 0.1f);
}

TEST_F(BrdfCommandTest, RefusesByName)
{
    writeText(folder_ / "short.binary", "123");
    writeText(folder_ / "text.bsdf", "no tensors here");
    writeText(folder_ / "text.brdf", "# empty\n");
    expectRefused({"brdf", path("short.binary")}, 3, {"short.binary", "has 3 bytes", "90x90x180"});
    expectRefused({"brdf", "merl:" + path("none")}, 3, {"none", "cannot be read"});
    expectRefused({"brdf", path("text.bsdf")}, 3, {"text.bsdf", "no tensor file"});
    expectRefused({"brdf", path("text.brdf")}, 3, {"text.brdf", "no measurement"});
    expectRefused({"brdf", path("text.brdf"), "--export", path("b.exr")}, 2, {"scattered"});
    expectRefused({"brdf", "velvet"}, 2, {"velvet", "merl:FILE"});
    expectRefused({"brdf", "merl:"}, 2, {"names no file"});
    expectRefused({"brdf"}, 2, {"MATERIAL"});
    expectRefused({"brdf", kGlossy, "--export", path("b.dds")}, 2, {"b.dds", ".ktx2"});
    expectRefused({"brdf", kGlossy, "--threads", "-1"}, 2, {"--threads"});
    expectRefused({"brdf", kGlossy, "--export", path("no/where.exr")}, 3, {"where.exr"});
    expectRefused({"brdf", kGlossy, "--against", path("short.binary")}, 3, {"short.binary"});
    saveImage(folder_ / "picture.exr", Image(4, 4, 3), PixelType::float32);
    expectRefused({"brdf", path("picture.exr")}, 3, {"picture.exr", "no BRDF table"});
    expectRefused({"render", "-o", path("r.png")}, 2, {"either a surface or a material"});
    expectRefused({"render", "--material", kGlossy, "-o", path("r.png")}, 2, {"no shape of its own"});
    expectRefused({"synth", path("c"), "--material", path("short.binary")}, 3, {"short.binary"});
    for (const char* name : {"b.exr", "b.dds", "r.png", "c"}) {
        EXPECT_FALSE(fs::exists(folder_ / name)) << name;
    }
}

} // namespace
} // namespace nacre
