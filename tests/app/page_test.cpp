// nacre export --page, and what a browser shows of it, held to the twin on the CPU.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/whole_file.h"
#include "engine/page/page_shape.h"
#include "engine/page/page_text.h"
#include "engine/scene/false_colour.h"
#include "engine/scene/reference.h"
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
        material.table.error.push_back(0.4f * static_cast<float>(i % 24) / 23); // uncertain away from the highlight
    }
    return material;
}

// Two materials side by side, one of them in natural coordinates; factors, a residual layer, and a height whose steps
// cast shadows.
Surface pageSurface()
{
    Surface surface = transferredSurface(bumpyNormals(kWidth, kHeight), glossyMaterial());
    surface.materials = {judgedMaterial({.diffuse = {0.4f, 0.3f, 0.2f}, .specular = glm::vec3(0.05f), .alpha = 0.3f},
                                        {kHalfDifference, kHalfPi / 2}, kHostile),
                         judgedMaterial({.diffuse = {0.1f, 0.2f, 0.4f}, .specular = glm::vec3(0.2f), .alpha = 0.5f},
                                        {kNatural, kHalfPi}, "second")};
    surface.albedo = Image(kWidth, kHeight, 3);
    surface.height = Image(kWidth, kHeight, 1);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const size_t pixel = surface.normals.index(x, y);
            surface.labels[pixel] = surface.labels[pixel] == 0 && x > 100 ? 1 : surface.labels[pixel];
            const float u = 0.1f * static_cast<float>(x), v = 0.07f * static_cast<float>(y);
            surface.albedo.setRgb(x, y, {1 + 0.5f * std::sin(u), 1 + 0.4f * std::sin(v), 1 + 0.3f * std::sin(u + v)});
            surface.height.at(x, y) = x / 60 % 2 == 0 ? 8.0f : 0.0f;
        }
    }
    surface.castsShadows = true;
    surface.lights = capturedRing(9);
    surface.residual = anyResidual(surface, 6);
    for (glm::vec3& weight : surface.residual.weights) {
        weight *= 0.2f;
    }
    return surface;
}

// What the page shows behind an address, and what it should show.
struct PageState {
    std::string hash;
    Image expected;
};

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

Image cropped(const Image& picture, const PageCrop& crop)
{
    Image part(crop.width, crop.height, 3);
    for (int y = 0; y < crop.height; ++y) {
        for (int x = 0; x < crop.width; ++x) {
            part.setRgb(x, y, picture.rgb(crop.x + x, crop.y + y));
        }
    }
    return part;
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

// Opens the page in frames of both widths, takes it to each state and writes the canvas's pixels into the document. The
// document's load, after which it is dumped, waits for a frame whose writing goes on.
std::string harness(const std::vector<PageState>& states)
{
    std::string hashes;
    for (const PageState& state : states) {
        hashes += fmt::format("\"{}&zoom=1\",", state.hash);
    }
    return R"(<!DOCTYPE html><meta charset="utf-8"><body><iframe id="hold"></iframe>
<iframe class="page" src="a.html" width="390" height="844"></iframe>
<iframe class="page" src="a.html" width="1280" height="800"></iframe>
<script>
const hold = document.getElementById("hold").contentDocument, hashes = [)" +
           hashes + R"(];
hold.open();
hold.write("<p>");
const say = text => document.body.append(Object.assign(document.createElement("p"), { textContent: text }));
async function show(frame, name) {
    if (!frame.contentWindow.nacrePage) {
        await new Promise(loaded => frame.addEventListener("load", loaded));
    }
    const page = await frame.contentWindow.nacrePage;
    hashes.forEach((hash, i) => {
        page.go(hash);
        const cut = document.createElement("canvas");
        cut.width = page.shape.width;
        cut.height = page.shape.height;
        cut.getContext("2d").drawImage(page.canvas, -page.frame.x, -page.frame.y);
        say(`picture ${name}-${i} ${cut.toDataURL("image/png").split(",")[1]} end`);
    });
    const root = frame.contentDocument.documentElement;
    say(`wider ${name} ${root.scrollWidth > frame.contentWindow.innerWidth} end`);
}
Promise.all([...document.querySelectorAll(".page")].map(frame => show(frame, frame.width)))
    .catch(error => say(`error ${error.stack} end`)).finally(() => hold.close());
</script>)";
}

std::string decoded64(const std::string& text)
{
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    uint32_t group = 0, bits = 0;
    for (const char c : text.substr(0, text.find('='))) {
        group = group << 6 | static_cast<uint32_t>(letters.find(c));
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(group >> bits & 0xFF);
        }
    }
    return bytes;
}

// What stands between a mark and " end" in a dumped document; empty where it is missing.
std::string saidBehind(const std::string& document, const std::string& mark)
{
    const size_t at = document.find(">" + mark);
    const size_t end = document.find(" end<", at);
    return at == document.npos || end == document.npos
               ? ""
               : document.substr(at + 1 + mark.size(), end - at - 1 - mark.size());
}

ProgramRun browse(const TempFolder& folder, const std::string& file)
{
    return runProgram("/usr/bin/timeout",
                      {"60", "chromium", "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                       "--enable-unsafe-swiftshader", "--no-first-run", "--allow-file-access-from-files",
                       "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", "--dump-dom",
                       "--user-data-dir=" + (folder / "profile").string(), "file://" + (folder / file).string()});
}

bool hasBrowser()
{
    return runProgram("/bin/sh", {"-c", "command -v chromium"}).exitCode == 0;
}

// Half a code of rounding each, and steps of the normals' 14 bits across a highlight or a shadow's border.
void expectShown(const std::string& document, const std::string& name, const Image& expected, const TempFolder& folder)
{
    writeText(folder / "shown.png", decoded64(saidBehind(document, "picture " + name + " ")));
    const Image shown = loadImage(folder / "shown.png");
    ASSERT_EQ(shown.width, expected.width);
    ASSERT_EQ(shown.height, expected.height);
    const CodeDifference difference = codeDifference(shown, expected, 2);
    if (getenv("SAY")) printf("%s largest %d beyond %zu of %zu\n", name.c_str(), difference.largest, difference.beyond, difference.pixels);
    EXPECT_LE(difference.share(), 0.001) << name << ": largest " << difference.largest;
}

TEST_F(Page, BrowserShowsWhatTheTwinDoes)
{
    if (!hasBrowser()) {
        GTEST_SKIP() << "needs chromium (apt.txt)";
    }
    const Surface surface = pageSurface();
    saveSurface(folder_ / "a.nacre", surface, false);
    saveNormalMap(folder_ / "n.exr", bumpyNormals(160, 120));
    const ProgramRun made = exported({"--onto", path("n.exr"), "--materials", "ggx:alpha=0.3", "--tolerance", "200dB"});
    ASSERT_EQ(made.exitCode, 0) << made.err;

    Surface own = surface;
    own.horizon = horizonMap(own.normals, own.height);
    Surface bare = own;
    bare.residual = {};
    const Surface moved = transferredSurface(bumpyNormals(160, 120), surface.materials[0]);
    const Light one = lightFrom({-0.4f, 0.5f, 0.8f}, {0.8f, 0.7f, 0.6f});
    const std::vector<Light> four = {one, lightFrom({0.6f, 0.2f, 0.7f}, {0.9f, 0.2f, 0.1f}),
                                     lightFrom({0.1f, -0.8f, 0.5f}, {0.1f, 0.5f, 0.2f}),
                                     lightFrom({-0.7f, -0.2f, 0.4f}, {0.1f, 0.2f, 0.8f})};
    const std::vector<Light> grazing = {lightFrom({0.95f, 0.1f, 0.2f}, glm::vec3(1.5f))};
    const std::vector<PageState> states = {
        stateOf(bare, {one}, "layer=off"),
        stateOf(bare, four, "layer=off"),
        stateOf(moved, four, "shape=1&material=0"),
        stateOf(own, {one, four[1]}, "layer=on"),
        stateOf(bare, {one}, "show=normals", Show::normals),
        stateOf(bare, {one}, "show=labels", Show::labels),
        stateOf(bare, four, "show=coverage&layer=off", Show::coverage),
        stateOf(own, grazing, "layer=on"),
        stateOf(moved, {lightFrom({0.3f, 0.4f, 0.6f}, glm::vec3(1), 1.2f)}, "shape=1&material=0")};
    writeText(folder_ / "harness.html", harness(states));
    const ProgramRun shown = browse(folder_, "harness.html");
    EXPECT_EQ(shown.err.find("CONSOLE"), std::string::npos) << shown.err;
    EXPECT_EQ(saidBehind(shown.out, "error "), "");
    for (const std::string width : {"390", "1280"}) {
        EXPECT_EQ(saidBehind(shown.out, "wider " + width + " "), "false");
        for (size_t i = 0; i < states.size(); ++i) {
            expectShown(shown.out, fmt::format("{}-{}", width, i), states[i].expected, folder_);
        }
    }
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
