// A material as a camera found it, by both paths.
#include <cstdio>

#include "engine/files/measures.h"
#include "engine/gpu/renderer.h"
#include "tests/gpu/gpu_test.h"
#include "tests/gpu/scenes.h"
#include "tests/support/data_folder.h"
#include "tests/support/run_nacre.h"

namespace nacre::test {
namespace {

class CapturedMaterialTest : public GpuTest {};

TEST_F(CapturedMaterialTest, BallsAreAsGoodAsLookups)
{
    NACRE_REQUIRE_DATA("diligent/bearPNG");
    const TempFolder folder;
    const std::string file = (folder / "bear.nacre").string();
    const ProgramRun run = runNacre({"acquire", (dataFolder() / "diligent/bearPNG").string(), "-o", file,
                                     "--lights-given", "20", "--normals", "least-squares"});
    ASSERT_EQ(run.exitCode, 0) << run.err;
    Renderer renderer(*context);
    const Surface surface = loadSurface(file);
    renderer.setSurface(surface);
    renderer.setLights(capOfLights(4, 35));
    renderer.setDisplay({.exposureStops = renderer.automaticExposure()});
    renderer.setPath(RenderPath::automatic);
    EXPECT_EQ(renderer.pathTaken(), RenderPath::ball) << renderer.whyDirect();
    const Image ball = renderer.picture();
    renderer.setPath(RenderPath::direct);
    const Image direct = renderer.picture();
    std::vector<uint8_t> mask(surface.labels.size());
    size_t pixels = 0, visible = 0;
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = surface.normals.confidence[i] > 0;
        pixels += mask[i];
        float worst = 0;
        for (size_t c = 0; c < 3; ++c) {
            worst = std::max(worst, std::abs(ball.values[3 * i + c] - direct.values[3 * i + c]));
        }
        visible += worst > 4.01f / 255;
    }
    const double psnr = picturePsnr(ball, direct, mask);
    const double share = static_cast<double>(visible) / static_cast<double>(pixels);
    EXPECT_GE(psnr, kLeastPsnr);
    EXPECT_LE(share, kLargestShare);
    const BallSize size = renderer.ballSizes()[0];
    std::printf("  ball %d, shown at %d: %.1f dB, %.3f %% off by more than 4/255\n", size.radiance, size.display, psnr,
                100 * share);
}

} // namespace
} // namespace nacre::test
