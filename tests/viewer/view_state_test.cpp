#include "engine/scene/scene_description.h"

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "engine/scene/scene_names.h"
#include "engine/view_state/choices.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// Every field differs from its default.
ViewState fullState(const std::filesystem::path& folder)
{
    return {
        .surface = folder / "a" / "horse.nacre",
        .material = "ggx:alpha=0.2",
        .onto = folder / "cloth.exr",
        .turn = {.yaw = 30.25f, .pitch = -15, .roll = 5},
        .normalY = NormalY::dx,
        .size = PictureSize{640, 480},
        .shadows = true,
        .lights = {{.captured = 3},
                   {.direction = {0.1f, -0.7f, 0.33333334f}, .irradiance = {1.1f, 0.3f, 7e-5f}, .softDegrees = 12.5f},
                   {.direction = {0, 0, 2}, .on = false}},
        .rig = {}, // not in files
        .environment = folder / "sky.hdr",
        .environmentLights = 64,
        .environmentTurn = -33.3f,
        .view = glm::vec3(0.1f, 0, 1),
        .path = RenderPath::direct,
        .exposure = 0.1f,
        .toneCurve = kToneFilmic,
        .show = Show::coverage,
        .residual = ResidualUse::alone,
        .frames = 7,
        .motion = LightMotion::sweep,
        .framing = {.zoom = 1.7f, .centre = {100.1f, 30.3f}},
        .materials = {"lambert:0.5", "merl:/x/gold.binary"},
        .targets = {folder / "head.nacre"},
        .environments = {folder / "sky.hdr", folder / "studio.exr"},
        .wipe = {.material = "lambert:0.5", .at = 0.3f}};
}

ViewState throughFile(const ViewState& state, const std::filesystem::path& file)
{
    writeTextFile(file, textOf(state, file.parent_path()));
    return sceneFromFile(file);
}

TEST(ViewState, ComesBackFromItsFileToTheBit)
{
    const TempFolder folder;
    const ViewState state = fullState(folder.path());
    EXPECT_EQ(throughFile(state, folder / "state.json"), state);
    EXPECT_EQ(throughFile({}, folder / "empty.json"), ViewState{});
    ViewState atCorner;
    atCorner.framing = {.zoom = 2, .centre = {0, 0}};
    EXPECT_EQ(throughFile(atCorner, folder / "corner.json"), atCorner);
}

TEST(SceneNames, EveryChoiceHasOne)
{
    for (const Show show :
         {Show::picture, Show::normals, Show::labels, Show::coverage, Show::thetaH, Show::thetaD, Show::verdicts}) {
        EXPECT_EQ(showFromName(nameOf(show)), show);
    }
    for (const ResidualUse use : {ResidualUse::on, ResidualUse::off, ResidualUse::alone}) {
        EXPECT_EQ(residualUseFromName(nameOf(use)), use);
    }
    for (const LightMotion motion :
         {LightMotion::none, LightMotion::turntable, LightMotion::sweep, LightMotion::object}) {
        EXPECT_EQ(motionFromName(nameOf(motion)), motion);
    }
    for (const RenderPath path : {RenderPath::automatic, RenderPath::direct, RenderPath::ball}) {
        EXPECT_EQ(pathFromName(nameOf(path)), path);
    }
    expectError([] { residualUseFromName("half"); }, {"layer half is not known", "on, off or alone"}, Error::kUsage);
}

TEST(ViewState, DefaultsAreNotWritten)
{
    EXPECT_EQ(textOf(ViewState{}, {}), "{\n  \"format\": \"nacre scene\",\n  \"version\": 1\n}\n");
}

TEST(ViewState, APhotographIsShownByItsLightAlone)
{
    ViewState one;
    one.surface = "a.nacre";
    one.lights = {{.captured = 3}};
    EXPECT_EQ(shownPhotograph(one), 2u);
    const auto without = [&](auto&& change) {
        ViewState state = one;
        change(state);
        return !shownPhotograph(state);
    };
    EXPECT_TRUE(without([](ViewState& s) { s.lights[0].captured = 0; }));
    EXPECT_TRUE(without([](ViewState& s) { s.lights.push_back({}); }));
    EXPECT_TRUE(without([](ViewState& s) { s.environment = "sky.hdr"; }));
    EXPECT_TRUE(without([](ViewState& s) { s.onto = "b.nacre"; })) << "another shape";
    EXPECT_TRUE(without([](ViewState& s) { s.surface.clear(); }));
}

TEST(ViewState, PathsAreRelativeToTheFile)
{
    const TempFolder folder;
    std::filesystem::create_directory(folder / "deep");
    const std::string text = textOf(fullState(folder.path()), folder / "deep");
    EXPECT_NE(text.find("\"../a/horse.nacre\""), std::string::npos) << text;
    EXPECT_EQ(text.find(folder.path().string()), std::string::npos) << text;
}

TEST(ViewState, RefusesWhatItDoesNotKnow)
{
    const TempFolder folder;
    const auto refused = [&](const std::string& keys, const std::vector<std::string>& fragments) {
        writeText(folder / "s.json", R"({"format": "nacre scene", "version": 1, )" + keys + "}");
        expectError([&] { sceneFromFile(folder / "s.json"); }, fragments);
    };
    refused(R"("colour": 1)", {"s.json", "unknown key 'colour'"});
    refused(R"("window": {"colour": 1})", {"s.json", "unknown key 'colour'", "window"});
    refused(R"("residual": "off")", {"s.json", "unknown key 'residual'", "'layer' in place"});
    refused(R"("light": "0,0,1")", {"s.json", "is not understood"});
    refused(R"("exposure": "bright")", {"s.json", "is not understood"});
}

TEST(LightSource, TextIsTheInverse)
{
    for (const char* text : {"0.3,0.4,0.87", "captured:7", "off:captured:7", "soft:10:0,0.5,1,1,0.9,0.8",
                             "off:soft:2.5:captured:1", "near:3:0.3,0.4,0.87", "soft:4:near:0.6:0,0,1"}) {
        EXPECT_EQ(textOf(lightSourceFromText(text)), text);
    }
}

TEST(LightSource, OffLightsGiveNothing)
{
    const std::vector<LightSource> sources = {lightSourceFromText("off:0,0,1"), lightSourceFromText("0,0,3")};
    const std::vector<Light> lights = lightsOf(sources, {});
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].direction, glm::vec3(0, 0, 1));
}

TEST(LightSource, KeepsItsDistance)
{
    const std::vector<CapturedLight> captured = {{"a", {{0, 0, 1}, {1, 1, 1}, 2.5f}}};
    EXPECT_EQ(lightOf(lightSourceFromText("captured:1"), captured).distance, 2.5f);
    for (const Light& light : lightsOf(std::vector{lightSourceFromText("soft:5:near:3:0,0,1")}, {})) {
        EXPECT_EQ(light.distance, 3);
    }
    ViewState state;
    state.lights = {{.captured = 1}};
    resolveCaptured(state, captured);
    EXPECT_EQ(state.lights[0].distance, 2.5f);
    expectError([] { lightSourceFromText("near:0.5:0,0,1"); }, {"near:0.5:0,0,1", "outside the object", "0.6 widths"},
                Error::kUsage);
}

TEST(LightSource, RefusesWhatIsNoLight)
{
    for (const char* text : {"", "1,2", "0,0,0", "0,0,-1", "1,2,3,-1,0,0", "captured:0", "soft:0:0,0,1",
                             "soft:91:0,0,1", "off:", "soft:5:off:0,0,1", "near:-1:0,0,1", "near:0:0,0,1",
                             "near:nan:0,0,1", "near:inf:0,0,1", "near:2", "near:2:captured:1"}) {
        expectError([&] { lightSourceFromText(text); }, {"light "}, Error::kUsage);
    }
    expectError([] { lightOf({.captured = 2}, {}); }, {"no captured light"}, Error::kUsage);
}

} // namespace
} // namespace nacre
