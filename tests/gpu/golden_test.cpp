// The pictures of tests/golden: the program still draws them, and each of them would show the mistakes that renderers
// are known for.
#include <algorithm>
#include <cstdio>

#include "engine/gpu/renderer.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/ball.h"
#include "engine/scene/reference.h"
#include "tests/gpu/golden_inputs.h"
#include "tests/gpu/golden_match.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scene_mutants.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {
namespace fs = std::filesystem;

// Goldens are of Mesa's software rasteriser, which is everywhere; another device is held to the same bounds.
std::string device()
{
    return deviceOfEnvironment().empty() ? "llvmpipe" : deviceOfEnvironment();
}

// The state files, by their stems.
std::vector<std::string> goldenNames()
{
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(fs::path(NACRE_SOURCE_DIR) / "tests/golden")) {
        if (entry.path().extension() == ".json") {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

class Golden : public GpuTest, public testing::WithParamInterface<std::string> {
protected:
    static void SetUpTestSuite() { open(device()); }

    static fs::path kept(const std::string& extension)
    {
        return fs::path(NACRE_SOURCE_DIR) / "tests/golden" / (GetParam() + extension);
    }
    // The state in a folder where it finds its inputs.
    static fs::path stateIn(const fs::path& folder)
    {
        const fs::path state = folder / "scene.json";
        fs::copy_file(kept(".json"), state);
        writeGoldenInputs(state);
        return state;
    }
};

// As its user would draw it. What it was drawn from stays in the build folder: the printed command repeats it.
TEST_P(Golden, IsDrawn)
{
    const fs::path folder = fs::path(NACRE_GOLDEN_WORK) / GetParam();
    fs::remove_all(folder);
    fs::create_directories(folder);
    const fs::path state = stateIn(folder), actual = folder / "actual.png";
    const ProgramRun run = runNacre(
        {"render", "--state", state.string(), "--fits", folder.string(), "--device", device(), "-o", actual.string()},
        "NACRE_VALIDATION=1");
    ASSERT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err.find("vulkan validation:"), std::string::npos) << run.err;
    const GoldenFiles files{.golden = kept(".png"), .evidence = folder};
    const bool bless = std::getenv("NACRE_BLESS") != nullptr;
    const testing::AssertionResult result = bless ? blessGolden(actual, files) : matchesGolden(actual, files);
    std::printf("  %s: %s\n", GetParam().c_str(), result.message());
    EXPECT_TRUE(result) << "again: nacre render --state " << state.string() << " --fits " << folder.string()
                        << " --device " << device() << " -o again.png";
}

// The same state drawn in this process, so that a scene can be altered before it is drawn.
class MutableState {
public:
    MutableState(const fs::path& state, const Context& context) : context_(context)
    {
        description_ = sceneFromFile(state);
        scene = loadScene(description_, {.fits = state.parent_path()}, context, false);
    }
    Display display() const
    {
        return {.exposureStops = description_.exposure.value(), .toneCurve = description_.toneCurve};
    }
    Image picture(const Scene& altered) const { return rendererOf(altered).picture(); }
    // By the CPU, along the path that the renderer takes.
    Image twin() const
    {
        Renderer renderer = rendererOf(scene);
        return renderer.pathTaken() == RenderPath::ball ? referenceBallPicture(scene, renderer.ballSizes(), display())
                                                        : displayedImage(renderReference(scene), display());
    }

    Scene scene;

private:
    Renderer rendererOf(const Scene& altered) const
    {
        Renderer renderer(context_);
        renderer.setSurface(altered.surface);
        renderer.setLights(altered.lights);
        renderer.setView(altered.view);
        renderer.setPath(description_.path);
        renderer.setDisplay(display());
        return renderer;
    }

    const Context& context_;
    SceneDescription description_;
};

void expectMissed(const char* mutant, const Image& picture, const Image& golden)
{
    const GoldenFigures figures = goldenFigures(picture, golden);
    EXPECT_FALSE(figures.pass()) << mutant << " is not seen: " << figures.text();
    std::printf("  %-28s %7.3f %% off, SSIM %.5f\n", mutant, 100 * figures.codes.share(), figures.structuralSimilarity);
}

// The bounds leave room for another implementation of the same formulas.
TEST_P(Golden, TakesTheTwin)
{
    const TempFolder folder;
    const MutableState state(stateIn(folder.path()), *context);
    const GoldenFigures figures = goldenFigures(state.twin(), loadImage(kept(".png")));
    EXPECT_TRUE(figures.pass()) << figures.text();
    std::printf("  %-28s %7.3f %% off, SSIM %.5f\n", "twin", 100 * figures.codes.share(), figures.structuralSimilarity);
}

TEST_P(Golden, HasTeeth)
{
    const TempFolder folder;
    const MutableState state(stateIn(folder.path()), *context);
    const Image golden = loadImage(kept(".png"));
    const Image right = state.picture(state.scene);
    ASSERT_TRUE(goldenFigures(right, golden).pass()) << goldenFigures(right, golden).text();
    for (const SceneMutant& mutant : sceneMutants()) {
        Scene altered = state.scene;
        if (mutant.alter(altered)) {
            expectMissed(mutant.name, state.picture(altered), golden);
        }
    }
    for (const PictureMutant& mutant : pictureMutants()) {
        expectMissed(mutant.name, mutant.alter(right), golden);
    }
}

INSTANTIATE_TEST_SUITE_P(Kept, Golden, testing::ValuesIn(goldenNames()), [](const auto& test) { return test.param; });

} // namespace
} // namespace nacre::test
