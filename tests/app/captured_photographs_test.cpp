// The photographs that a window shows beside a surface: verdicts on a whole picture and under the cursor are one.
#include "app/materials/captured_photographs.h"

#include <array>
#include <atomic>

#include <gtest/gtest.h>

#include "tests/support/run_nacre.h"

namespace nacre {
namespace {

TEST(CapturedPhotographs, VerdictsOnAPictureAreThoseOfItsPixels)
{
    const TempFolder folder;
    const std::string capture = (folder / "capture").string(), surface = (folder / "s.nacre").string();
    ASSERT_EQ(runNacre({"synth", capture, "--lights", "8", "--side", "48", "--give-lights"}).exitCode, 0);
    ASSERT_EQ(runNacre({"acquire", capture, "-o", surface, "--normals", "consensus"}).exitCode, 0);
    const std::unique_ptr<Photographs> photographs = photographsOf(capture, surface);
    std::atomic<bool> isWhole = false; // told from several threads
    photographs->load([&](float share) { isWhole = isWhole || share == 1; }, false);
    EXPECT_TRUE(isWhole) << "all of it is read and judged";
    const glm::ivec2 size = photographs->size();
    std::vector<std::vector<uint8_t>> verdicts;
    for (size_t light = 0; light < 8; ++light) {
        verdicts.push_back(photographs->verdicts(light));
    }
    std::array<size_t, kVerdictKinds.size()> counts{};
    for (size_t pixel = 0; pixel < static_cast<size_t>(size.x * size.y); ++pixel) {
        std::vector<uint8_t> wanted(8, kNotJudged);
        for (const PixelObservation& observation : photographs->observations(pixel)) {
            wanted[observation.light] = observation.verdict;
            ++counts[observation.verdict];
            // Attached shadow is the one that follows from the normal alone.
            EXPECT_TRUE(observation.nDotL > 0 || kVerdictKinds[observation.verdict].name == std::string("shadow"));
        }
        for (size_t light = 0; light < 8; ++light) {
            ASSERT_EQ(verdicts[light][pixel], wanted[light]) << "pixel " << pixel << ", light " << light;
        }
    }
    EXPECT_GT(counts[0], counts[1]) << "most of the object is lit";
    EXPECT_GT(counts[1], 0u);
}

} // namespace
} // namespace nacre
