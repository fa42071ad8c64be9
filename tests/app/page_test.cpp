// nacre export --page, and what a browser shows of it, held to the twin on the CPU.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "acquisition/capture/capture.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/whole_file.h"
#include "engine/page/page_shape.h"
#include "engine/page/page_text.h"
#include "engine/scene/false_colour.h"
#include "engine/scene/reference.h"
#include "engine/surface/object_places.h"
#include "tests/app/page_browser.h"
#include "tests/gpu/scenes.h"
#include "tests/support/expect_one_line.h"
#include "tests/support/residual_surface.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

constexpr const char* kHostile = "\"</script><script>throw 1</script><!--<b>&'";
constexpr int kWidth = 230, kHeight = 190;

Material judgedMaterial(const LambertGgx& model, TableDomain domain, const std::string& name)
{
    Material material = materialOf(model, domain, {24, 12, 8});
    material.name = name;
    for (size_t i = 0; i < material.table.values.size(); ++i) {
        const size_t phiD = i / (24 * 12);
        material.table.values[i] *= 1 + 0.1f * static_cast<float>(phiD);
        material.table.error.push_back(0.4f * static_cast<float>(i % 24) / 23); // uncertain away from the highlight
    }
    return material;
}

// Two materials side by side, one-way and in natural coordinates; factors, a residual layer, and a height whose steps
// cast shadows. A page stores a part of the picture, which is not in its middle.
Surface pageSurface()
{
    Surface surface = transferredSurface(bumpyNormals(kWidth, kHeight), glossyMaterial());
    surface.materials = {judgedMaterial({.diffuse = {0.4f, 0.3f, 0.2f}, .specular = glm::vec3(0.05f), .alpha = 0.3f},
                                        {kOneWay, kHalfPi / 2}, kHostile),
                         judgedMaterial({.diffuse = {0.1f, 0.2f, 0.4f}, .specular = glm::vec3(0.2f), .alpha = 0.5f},
                                        {kNatural, kHalfPi}, "second")};
    surface.albedo = Image(kWidth, kHeight, 3);
    surface.height = Image(kWidth, kHeight, 1);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const size_t pixel = surface.normals.index(x, y);
            surface.labels[pixel] = surface.labels[pixel] == 0 && x > 100 ? 1 : surface.labels[pixel];
            if (x < 11 || y > 170) {
                surface.labels[pixel] = Surface::kNoMaterial;
                surface.normals.confidence[pixel] = 0;
            }
            const float u = 0.1f * static_cast<float>(x), v = 0.07f * static_cast<float>(y);
            surface.albedo.setRgb(x, y, {1 + 0.5f * std::sin(u), 1 + 0.4f * std::sin(v), 1 + 0.3f * std::sin(u + v)});
            surface.height.at(x, y) = ((x + y / 3) / 60 % 2 == 0 ? 8.0f : 0.0f) + 4 * std::sin(3 * u) * std::sin(5 * v);
        }
    }
    surface.albedo.setRgb(kWidth / 2, kHeight / 2, glm::vec3(5000)); // as pixels of hardly any light have them
    surface.castsShadows = true;
    surface.camera = glm::vec3(0.1f, -0.2f, 2.2f);
    surface.lights = capturedRing(9);
    surface.lights[0].light.distance = 2; // near lights go by the pixels' heights
    surface.residual = anyResidual(surface, 6);
    for (glm::vec3& weight : surface.residual.weights) {
        weight *= 0.2f;
    }
    return surface;
}

// The same without what balls cannot show: shadows, and lights and a camera near by.
Surface farSurface()
{
    Surface surface = pageSurface();
    surface.castsShadows = false;
    surface.camera.reset();
    surface.lights[0].light.distance = std::numeric_limits<float>::infinity();
    return surface;
}

// A small one with a residual layer.
Surface smallSurface()
{
    Surface surface = transferredSurface(bumpyNormals(24, 24), glossyMaterial());
    surface.lights = capturedRing(9);
    surface.residual = anyResidual(surface, 6);
    return surface;
}

class Page : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    ProgramRun exported(std::vector<std::string> more)
    {
        std::vector<std::string> arguments = {"export", path("a.nacre"), "--page", path("a.html")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runNacre(arguments);
    }

    TempFolder folder_;
};

std::string hashOf(const std::vector<Light>& lights, float exposure, const std::string& more)
{
    std::string text;
    for (const Light& l : lights) {
        const glm::vec3 &d = l.direction, &e = l.irradiance;
        text += fmt::format("{}{},{},{},{},{},{}", text.empty() ? "" : ";", d.x, d.y, d.z, e.x, e.y, e.z);
        text += isNear(l) ? fmt::format(",{}", l.distance) : "";
    }
    return fmt::format("#light={}&exposure={}&{}", text, exposure, more);
}

PageState stateOf(const Surface& surface, std::vector<Light> lights, const std::string& more, Show show = Show::picture)
{
    constexpr float kStops = 0.5f;
    const Scene scene{surface, std::move(lights)};
    const Display display{.exposureStops = kStops};
    const Image picture = show == Show::picture ? displayedImage(renderReference(scene), display)
                                                : referenceFalseColour(scene, show, display);
    return {hashOf(scene.lights, kStops, more), cropped(picture, cropOf(surface.normals))};
}

Light lightFrom(glm::vec3 direction, glm::vec3 irradiance, float distance = std::numeric_limits<float>::infinity())
{
    return {glm::normalize(direction), irradiance, distance};
}

// Half a code of rounding each, and steps of the normals' 14 bits across a highlight or a shadow's border.
void expectAlike(const Image& shown, const Image& expected, const std::string& name)
{
    ASSERT_EQ(shown.width, expected.width);
    ASSERT_EQ(shown.height, expected.height);
    const CodeDifference difference = codeDifference(shown, expected, 2);
    EXPECT_LE(difference.share(), 0.001) << name << ": largest " << difference.largest;
}

std::vector<Light> fourLights()
{
    return {lightFrom({-0.4f, 0.5f, 0.8f}, {0.8f, 0.7f, 0.6f}), lightFrom({0.6f, 0.2f, 0.7f}, {0.9f, 0.2f, 0.1f}),
            lightFrom({0.1f, -0.8f, 0.5f}, {0.1f, 0.5f, 0.2f}), lightFrom({-0.7f, -0.2f, 0.4f}, {0.1f, 0.2f, 0.8f})};
}

// The states of a.html.
std::vector<PageState> writeSurfacePage(const TempFolder& folder)
{
    const Surface surface = pageSurface();
    saveSurface(folder / "a.nacre", surface, false);
    saveNormalMap(folder / "n.exr", bumpyNormals(320, 240));
    const ProgramRun made =
        runNacre({"export", (folder / "a.nacre").string(), "--page", (folder / "a.html").string(), "--onto",
                  (folder / "n.exr").string(), "--materials", (folder / "a.nacre#2").string(), "--tolerance", "200dB"});
    EXPECT_EQ(made.exitCode, 0) << made.err;
    Surface own = surface;
    own.horizon = horizonMap(own.normals, heightInPicture(own));
    Surface bare = own;
    bare.residual = {};
    const Surface moved = transferredSurface(bumpyNormals(320, 240), surface.materials[0]);
    const std::vector<Light> four = fourLights();
    const Light one = four[0];
    const Light unmeasured = lightFrom({0.95f, 0.1f, 0.2f}, glm::vec3(1.5f));
    const Light near = lightFrom({0.3f, 0.4f, 0.6f}, glm::vec3(1), 1.2f);
    return {stateOf(bare, {one}, "layer=off"),
            stateOf(bare, four, "layer=off"),
            stateOf(moved, four, "shape=1&material=0"),
            stateOf(own, {one, four[1]}, "layer=on"),
            stateOf(bare, {one}, "show=normals", Show::normals),
            stateOf(bare, {one}, "show=labels", Show::labels),
            stateOf(bare, four, "show=coverage&layer=off", Show::coverage),
            stateOf(own, {unmeasured}, "layer=on"),
            stateOf(bare, {near}, "layer=off")};
}

// The states of c.html, where balls of three materials take the place of tables.
std::vector<PageState> writeFarPage(const TempFolder& folder)
{
    const Surface surface = farSurface();
    saveSurface(folder / "c.nacre", surface, false);
    Surface glossy = farSurface();
    glossy.residual = {};
    glossy.materials = {
        materialOf(LambertGgx{.diffuse = {0.2f, 0.1f, 0.05f}, .specular = glm::vec3(0.1f), .alpha = 0.12f},
                   {kHalfDifference, kHalfPi / 2}, {60, 16, 8})};
    std::fill(glossy.labels.begin(), glossy.labels.end(), uint8_t{0});
    saveSurface(folder / "glossy.nacre", glossy, false);
    const ProgramRun made = runNacre({"export", (folder / "c.nacre").string(), "--page", (folder / "c.html").string(),
                                      "--materials", (folder / "glossy.nacre").string(), "--tolerance", "200dB"});
    EXPECT_EQ(made.exitCode, 0) << made.err;
    std::vector<Light> eight = fourLights();
    for (const Light& light : fourLights()) {
        const glm::vec3 &d = light.direction, &e = light.irradiance;
        eight.push_back(lightFrom({d.y, -d.x, 1.5f * d.z}, 0.4f * glm::vec3(e.z, e.y, e.x)));
    }
    return {stateOf(surface, eight, "layer=on"),
            stateOf(transferredSurface(surface, glossy.materials[0]), eight, "material=2")};
}

// A capture of which two photographs are held back, and the page of the rest: what these two show, and what the program
// says that they should.
struct HeldOutPhotographs {
    std::vector<PageState> states; // of b.html, with the photographs
    std::vector<double> rendered;  // dB of nacre's own pictures
    std::vector<uint8_t> mask;     // of the crop
};

HeldOutPhotographs writeHeldOutPage(const TempFolder& folder)
{
    const auto path = [&](const std::string& name) { return (folder / name).string(); };
    EXPECT_EQ(runNacre({"synth", path("capture"), "--quiet", "--shape", "bumpy", "--side", "96", "--sphere-size", "48",
                        "--lights", "14", "--give-lights"})
                  .exitCode,
              0);
    EXPECT_EQ(runNacre({"acquire", path("capture"), "-o", path("b.nacre"), "--quiet", "--normals", "consensus",
                        "--skip", "object_03.png", "--skip", "object_09.png"})
                  .exitCode,
              0);
    EXPECT_EQ(runNacre({"export", path("b.nacre"), "--page", path("b.html"), "--quiet"}).exitCode, 0);
    const Capture capture = loadCapture(folder / "capture");
    Surface surface = loadSurface(folder / "b.nacre");
    if (surface.castsShadows) {
        surface.horizon = horizonMap(surface.normals, surface.height);
    }
    HeldOutPhotographs held;
    for (const size_t i : {2, 8}) {
        const Photograph& photograph = capture.photographs[i];
        const Scene scene{surface, {capture.lights[i]}};
        PageState state = stateOf(surface, scene.lights, "layer=on");
        held.mask.clear();
        const PageCrop crop = cropOf(surface.normals);
        for (int y = 0; y < crop.height; ++y) {
            for (int x = 0; x < crop.width; ++x) {
                held.mask.push_back(surface.normals.confidence[surface.normals.index(crop.x + x, crop.y + y)] > 0);
            }
        }
        const Image truth = cropped(
            displayedImage(loadPhotograph(photograph.exposures.front().file, capture.curve), {.exposureStops = 0.5f}),
            crop);
        held.rendered.push_back(picturePsnr(state.expected, truth, held.mask));
        held.states.push_back({state.hash, truth});
    }
    return held;
}

TEST_F(Page, BrowserShowsWhatTheTwinAndThePhotographsDo)
{
    if (!hasBrowser()) {
        GTEST_SKIP() << "needs chromium (apt.txt)";
    }
    const std::vector<PageState> states = writeSurfacePage(folder_);
    const std::vector<PageState> farStates = writeFarPage(folder_);
    const HeldOutPhotographs held = writeHeldOutPage(folder_);
    const std::vector<PageFrame> frames = {{"phone", "a.html", 390, states},
                                           {"desk", "a.html", 1280, states},
                                           {"far-phone", "c.html", 390, farStates},
                                           {"far-desk", "c.html", 1280, farStates}};
    std::vector<PageFrame> all = frames;
    all.push_back({"held", "b.html", 390, held.states});
    writeText(folder_ / "harness.html", harness(all));
    const ProgramRun shown = browse(folder_, "harness.html");
    EXPECT_EQ(shown.err.find("CONSOLE"), std::string::npos) << shown.err;
    EXPECT_EQ(saidBehind(shown.out, "error "), "");
    for (const auto& [frame, file, width, expected] : frames) {
        EXPECT_EQ(saidBehind(shown.out, "wider " + frame + " "), "false");
        EXPECT_EQ(saidBehind(shown.out, "gestures " + frame + " "),
                  fmt::format("moved 2.00 0.50 {} normals", file == "c.html" ? 8 : 2));
        if (file == "c.html") {
            EXPECT_EQ(saidBehind(shown.out, "balls " + frame + " "), "2"); // of the first state's materials
        }
        for (size_t i = 0; i < expected.size(); ++i) {
            const std::string name = fmt::format("{}-{}", frame, i);
            expectAlike(shownPicture(shown.out, name, folder_), expected[i].expected, name);
        }
        expectAlike(shownPicture(shown.out, frame + "-again", folder_), expected[0].expected, "after a lost context");
    }
    for (size_t i = 0; i < held.states.size(); ++i) {
        const Image picture = shownPicture(shown.out, fmt::format("held-{}", i), folder_);
        EXPECT_NEAR(picturePsnr(picture, held.states[i].expected, held.mask), held.rendered[i], 0.3);
        EXPECT_GT(held.rendered[i], 25); // of a picture of the right thing
    }
}

// A browser ends a script element at the first </script>, wherever it stands.
TEST_F(Page, NamesAreText)
{
    Surface surface = smallSurface();
    surface.materials[0].name = kHostile;
    surface.lights[0].photograph = kHostile;
    saveSurface(folder_ / "a.nacre", surface, false);
    ASSERT_EQ(exported({}).exitCode, 0);
    const std::string page = readTextFile(path("a.html"));
    EXPECT_EQ(page.find("throw 1</"), std::string::npos);
    EXPECT_EQ(page.find("<b>"), std::string::npos);
    EXPECT_NE(page.find("\\u003c/script>\\u003cscript>throw 1"), std::string::npos);
    fs::rename(folder_ / "a.nacre", folder_ / "<b>&\".nacre");
    ASSERT_EQ(runNacre({"export", path("<b>&\".nacre"), "--page", path("b.html")}).exitCode, 0);
    EXPECT_NE(readTextFile(path("b.html")).find("<title>&lt;b&gt;&amp;&quot;</title>"), std::string::npos);
}

TEST_F(Page, SaysWhatItTookAndKeepsToItsBudget)
{
    saveSurface(folder_ / "a.nacre", pageSurface(), false);
    const ProgramRun whole = exported({"--threads", "1"});
    ASSERT_EQ(whole.exitCode, 0) << whole.err;
    for (const char* said : {"KiB residual layer", "KiB heights", "KiB normals", "agrees with the full measurement"}) {
        EXPECT_NE(whole.out.find(said), std::string::npos) << said << " is not in: " << whole.out;
    }
    EXPECT_EQ(whole.out.find("left out"), std::string::npos) << whole.out;
    const std::string text = readTextFile(path("a.html"));
    ASSERT_EQ(exported({"--threads", "3", "--force", "--quiet"}).exitCode, 0);
    EXPECT_EQ(readTextFile(path("a.html")), text);
    const ProgramRun small = exported({"--budget-bytes", "280KiB", "--force"});
    ASSERT_EQ(small.exitCode, 0) << small.err;
    EXPECT_LE(fs::file_size(path("a.html")), 280u << 10);
    EXPECT_NE(small.out.find("left out for size"), std::string::npos) << small.out;
    EXPECT_NE(readTextFile(path("a.html")).find("Left out for size"), std::string::npos);
    expectOneLine(exported({"--budget-bytes", "50KiB", "--force"}), Error::kUsage, {"--budget-bytes", "or more"});
}

TEST_F(Page, TakesLargeShapesDown)
{
    saveSurface(folder_ / "a.nacre", transferredSurface(bumpyNormals(8192, 16), glossyMaterial()), false);
    const ProgramRun made = exported({"--gltf", path("a.glb")});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_NE(made.err.find("a has 8192x16 pixels: the page has every 4.00th, 2048x4"), std::string::npos) << made.err;
    EXPECT_NE(made.out.find("textures are made smaller, 8192 pixels to 4096"), std::string::npos) << made.out;
}

TEST_F(Page, RefusesWithTheRightCode)
{
    Surface surface = smallSurface();
    saveSurface(folder_ / "a.nacre", surface, false);
    expectOneLine(exported({"--size", "25x25"}), Error::kUsage, {"--size 25x25", "24x24"});
    expectOneLine(runNacre({"export", path("a.nacre"), "--page", path("a.png")}), Error::kUsage,
                  {"--page", "NAME.html"});
    expectOneLine(runNacre({"export", path("a.nacre"), "--albedo", path("a.exr"), "--onto", "make:head"}),
                  Error::kUsage, {"--page FILE.html"});
    expectOneLine(exported({"--photographs", "3"}), Error::kUsage, {"--capture"});
    expectOneLine(exported({"--photographs", "25", "--capture", path("c")}), Error::kUsage, {"--photographs 25"});
    expectOneLine(exported({"--photographs", "10", "--capture", path("c")}), Error::kUsage, {"at most 9"});
    expectOneLine(exported({"--photographs", "2", "--capture", path("c")}), Error::kData, {path("c")});
    expectOneLine(exported({"--onto", path("no.obj")}), Error::kData, {"no.obj"});
    saveSurface(folder_ / "empty.nacre", transferredSurface(NormalMap(8, 8), surface.materials[0]), false);
    expectOneLine(exported({"--onto", path("empty.nacre")}), Error::kData, {"empty.nacre", "normal"});
    surface.materials[0].table.values[5] = glm::vec3(1e6f);
    saveSurface(folder_ / "a.nacre", surface, true);
    expectOneLine(exported({}), Error::kData, {"material model", "half floats"});
    surface.materials.clear();
    std::fill(surface.labels.begin(), surface.labels.end(), Surface::kNoMaterial);
    surface.residual = {};
    saveSurface(folder_ / "a.nacre", surface, true);
    expectOneLine(exported({}), Error::kData, {"a.nacre", "without a material"});
    EXPECT_FALSE(fs::exists(path("a.html")));
    writeText(folder_ / "a.html", "mine");
    expectOneLine(exported({}), Error::kData, {"a.html", "exists already"});
    EXPECT_EQ(readTextFile(path("a.html")), "mine");
}

// As the page has them: with the headers in place of their include lines.
TEST_F(Page, ShadersAndEverySharedHeaderAreGlslEs)
{
    const auto expectCompiles = [&](const std::string& file, const std::string& text) {
        writeText(folder_ / file, text);
        const ProgramRun compiled = runProgram(NACRE_GLSLANG, {path(file)});
        EXPECT_EQ(compiled.exitCode, 0) << file << ": " << compiled.out;
    };
    for (const char* name : {"fullscreen.vert", "shade.frag", "photograph.frag", "screen.frag"}) {
        expectCompiles(name, pageShader(name));
    }
    size_t headers = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(NACRE_SOURCE_DIR) / "shaders/shared")) {
        const std::string name = entry.path().filename().string();
        expectCompiles(name + ".frag", "#version 300 es\nprecision highp float;\nprecision highp int;\n" +
                                           pageShader("shared/" + name) + "void main() {}\n");
        ++headers;
    }
    EXPECT_GT(headers, 10u);
}

} // namespace
} // namespace nacre::test
