#include "assets/synth/synth_capture.h"

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/surface/normal_map.h"
#include "shared/glsl.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

SynthOptions tinyOptions()
{
    SynthOptions options;
    options.width = options.height = 32;
    options.sphereSize = 32;
    options.lights = 4;
    options.threads = 1;
    return options;
}

void write(const fs::path& folder, const SynthOptions& options, bool replace = false)
{
    writeSynthCapture(folder, makeSynthScene(options), replace);
}

nlohmann::json documentOf(const fs::path& file)
{
    return nlohmann::json::parse(readTextFile(file));
}

// Every file's bytes by its name in the folder.
std::map<std::string, std::string> bytesOf(const fs::path& folder)
{
    std::map<std::string, std::string> bytes;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            bytes[fs::relative(entry.path(), folder).string()] = readTextFile(entry.path());
        }
    }
    return bytes;
}

TEST(SynthCapture, WritesWhatItsDocumentNames)
{
    TempFolder temp;
    write(temp / "capture", tinyOptions());
    nlohmann::json capture = documentOf(temp / "capture" / "capture.json");
    EXPECT_EQ(capture["format"], "nacre capture");
    EXPECT_EQ(capture["version"], 1);
    EXPECT_EQ(capture["transfer"], "linear");
    ASSERT_EQ(capture["photographs"].size(), 4u);
    for (const auto& photograph : capture["photographs"]) {
        EXPECT_TRUE(fs::exists(temp / "capture" / std::string(photograph["file"])));
        EXPECT_FALSE(photograph.contains("light")) << "they are to be calibrated";
    }
    for (const char* sphere : {"mirrorSphere", "diffuseSphere"}) {
        ASSERT_EQ(capture[sphere]["photographs"].size(), 4u);
        for (const std::string file : capture[sphere]["photographs"]) {
            EXPECT_TRUE(fs::exists(temp / "capture" / file)) << file;
        }
        EXPECT_TRUE(fs::exists(temp / "capture" / std::string(capture[sphere]["mask"])));
    }
    EXPECT_TRUE(fs::exists(temp / "capture" / std::string(capture["mask"])));
    EXPECT_TRUE(fs::exists(temp / "capture" / std::string(capture["truthNormals"])));
}

TEST(SynthCapture, WritesItsTruth)
{
    TempFolder temp;
    SynthScene scene = makeSynthScene(tinyOptions());
    writeSynthCapture(temp / "capture", scene, false);
    NormalMap normals = loadNormalMap(temp / "capture" / "truth" / "normals.exr");
    ASSERT_EQ(normals.normals.size(), scene.view.normals.normals.size());
    for (size_t i = 0; i < normals.normals.size(); ++i) {
        EXPECT_NEAR(length(normals.normals[i] - scene.view.normals.normals[i]), 0.0f, 1e-6f);
    }
    nlohmann::json lights = documentOf(temp / "capture" / "truth" / "lights.json");
    EXPECT_EQ(lights["format"], "nacre lights");
    ASSERT_EQ(lights["lights"].size(), 4u);
    EXPECT_EQ(lights["lights"][2]["photograph"], "object_03.png");
    EXPECT_FLOAT_EQ(lights["lights"][2]["direction"][0], scene.lights[2].direction.x);
    EXPECT_FLOAT_EQ(lights["lights"][2]["irradiance"][1], scene.lights[2].irradiance.y);
    nlohmann::json brdf = documentOf(temp / "capture" / "truth" / "brdf.json");
    EXPECT_DOUBLE_EQ(brdf["radianceScale"], scene.sensor.gain);
    EXPECT_FLOAT_EQ(brdf["parameters"]["diffuse"][0], 0.5f);
}

// A file of the format that is not clipped: its value is the scale times f E n.l, with the truth beside it.
TEST(SynthCapture, FloatPhotographsObeyTheReflectanceEquation)
{
    TempFolder temp;
    SynthOptions options = tinyOptions();
    options.shape = SynthShape::sphere;
    options.material = "lambert:0.6,0.5,0.4";
    options.noise = 0;
    options.format = SynthFormat::exr;
    options.giveLights = true;
    write(temp / "capture", options);
    nlohmann::json photograph = documentOf(temp / "capture" / "capture.json")["photographs"][3];
    double scale = documentOf(temp / "capture" / "truth" / "brdf.json")["radianceScale"];
    NormalMap normals = loadNormalMap(temp / "capture" / "truth" / "normals.exr");
    Image picture = loadPhotograph(temp / "capture" / std::string(photograph["file"]), TransferCurve::linear);
    auto jsonVector = [](const nlohmann::json& v) { return vec3(v[0], v[1], v[2]); };
    vec3 l = jsonVector(photograph["light"]["direction"]);
    vec3 E = jsonVector(photograph["light"]["irradiance"]);
    for (size_t i = 0; i < normals.normals.size(); ++i) {
        vec3 expected = vec3(0.6f, 0.5f, 0.4f) / kPi * E * max(dot(normals.normals[i], l), 0.0f) * float(scale);
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(picture.values[3 * i + c], expected[c], 1e-5f);
        }
    }
}

TEST(SynthCapture, IntegerBracketsAgreeAndTheLongestClips)
{
    TempFolder temp;
    SynthOptions options = tinyOptions();
    options.noise = 0;
    options.exposures = {4, 1};
    write(temp / "capture", options);
    nlohmann::json photograph = documentOf(temp / "capture" / "capture.json")["photographs"][0];
    ASSERT_EQ(photograph["exposures"].size(), 2u);
    EXPECT_EQ(photograph["exposures"][0]["file"], "object_01_a.png");
    EXPECT_EQ(photograph["exposures"][1]["seconds"], 1.0);
    Image longer = loadPhotograph(temp / "capture" / "object_01_a.png", TransferCurve::linear);
    Image shorter = loadPhotograph(temp / "capture" / "object_01_b.png", TransferCurve::linear);
    size_t clipped = 0;
    for (size_t i = 0; i < longer.values.size(); ++i) {
        if (longer.values[i] >= 1.0f) {
            ++clipped;
            EXPECT_GE(shorter.values[i], 0.2499f);
        } else {
            // Half a code value of 65535 in the short one, four times over, and half in the long one.
            EXPECT_NEAR(longer.values[i], 4.0f * shorter.values[i], 2.6f / 65535.0f);
        }
    }
    EXPECT_GT(clipped, 10u);
}

TEST(SynthCapture, IsTheSameBytesForAnyNumberOfThreads)
{
    TempFolder temp;
    SynthOptions options = tinyOptions();
    options.shadowMasks = true;
    write(temp / "one", options);
    options.threads = 2;
    write(temp / "two", options);
    options.seed = 2;
    write(temp / "other", options);
    EXPECT_EQ(bytesOf(temp / "one"), bytesOf(temp / "two"));
    EXPECT_NE(bytesOf(temp / "one").at("object_01.png"), bytesOf(temp / "other").at("object_01.png"));
    EXPECT_EQ(bytesOf(temp / "one").count("truth/shadow_04.png"), 1u);
}

TEST(SynthCapture, RefusesWhatExistsAndLeavesNothingBehind)
{
    TempFolder temp;
    write(temp / "capture", tinyOptions());
    expectError([&] { write(temp / "capture", tinyOptions()); }, {"exists"});
    EXPECT_NO_THROW(write(temp / "capture", tinyOptions(), true));
    fs::create_directory(temp / "letters");
    expectError([&] { write(temp / "letters", tinyOptions(), true); }, {"letters", "no capture"});
    size_t entries = std::distance(fs::directory_iterator(temp.path()), fs::directory_iterator());
    EXPECT_EQ(entries, 2u) << "the capture and the letters";
}

TEST(SynthCapture, TheDemosIsSmall)
{
    SynthOptions demo = demoCapture();
    EXPECT_EQ(demo.lights, 36);
    EXPECT_LE(demo.width * demo.height, 320 * 320);
    EXPECT_NO_THROW(makeSynthScene(demo));
}

} // namespace
} // namespace nacre
