#include "tests/gpu/golden_match.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/files/whole_file.h"

namespace nacre::test {
namespace fs = std::filesystem;

namespace {

// Lavapipe gives the same bytes for every vector width and with its optimiser off; another version or device rounds
// radiance otherwise, so that a value near a step takes the neighbouring code: one. The twin on the CPU, another
// implementation of the same formulas, shows how far that goes (Golden.TakesTheTwin).
constexpr int kCodeTolerance = 1;
// At the terminator, the horizon and where normals of 16 bits choose a ball's nearest texel, single pixels go further.
constexpr double kFailingShare = 0.001;
// One value in twenty may be off by its one code; the twin stays above 0.9998.
constexpr double kLeastSimilarity = 0.999;

constexpr size_t kLeastColours = 200;
constexpr double kMostBlack = 0.7;    // of the pixels
constexpr double kMostClipped = 0.02; // with a channel at 255

constexpr float kAmplification = 16; // of the difference's picture

std::string sizeText(const Image& image)
{
    return fmt::format("{}x{}x{}", image.width, image.height, image.channels);
}

Image amplifiedDifference(const Image& a, const Image& b)
{
    Image difference = a;
    for (size_t i = 0; i < a.values.size(); ++i) {
        difference.values[i] = kAmplification * std::abs(a.values[i] - b.values[i]);
    }
    return difference;
}

bool sameSize(const Image& a, const Image& b)
{
    return a.width == b.width && a.height == b.height && a.channels == b.channels;
}

// Why there is nothing to compare with; empty where there is.
std::string whyNoGolden(const Image& picture, const fs::path& golden)
{
    if (!fs::exists(golden)) {
        return fmt::format("{}: is missing; look at the picture, then scripts/bless_goldens.sh", golden.string());
    }
    const Image kept = loadImage(golden);
    const std::string noGuard = whyNoGuard(kept);
    if (!noGuard.empty()) {
        return fmt::format("{}: {}; a golden has to show something", golden.string(), noGuard);
    }
    if (!sameSize(kept, picture)) {
        return fmt::format("{}: is {}; the picture is {}", golden.string(), sizeText(kept), sizeText(picture));
    }
    return "";
}

void keepEvidence(const Image& picture, const Image& golden, const std::string& figures, const GoldenFiles& files)
{
    fs::copy_file(files.golden, files.evidence / "golden.png", fs::copy_options::overwrite_existing);
    saveImage(files.evidence / "difference.png", amplifiedDifference(picture, golden), PixelType::uint8);
    writeTextFile(files.evidence / "figures.txt", figures + "\n");
}

} // namespace

bool GoldenFigures::pass() const
{
    return codes.share() <= kFailingShare && structuralSimilarity >= kLeastSimilarity;
}

std::string GoldenFigures::text() const
{
    return fmt::format("{} of {} pixels ({:.3f} %) off by more than {} codes (at most {:.3f} %), the worst by {}; SSIM "
                       "{:.5f} (at least {})",
                       codes.beyond, codes.pixels, 100 * codes.share(), kCodeTolerance, 100 * kFailingShare,
                       codes.largest, structuralSimilarity, kLeastSimilarity);
}

GoldenFigures goldenFigures(const Image& actual, const Image& golden)
{
    return {codeDifference(actual, golden, kCodeTolerance), structuralSimilarity(actual, golden)};
}

std::string whyNoGuard(const Image& picture)
{
    std::set<std::tuple<float, float, float>> colours;
    size_t black = 0, clipped = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::vec3 v = picture.rgb(x, y);
            colours.insert({v.x, v.y, v.z});
            const float brightest = std::max({v.x, v.y, v.z});
            black += brightest == 0;
            clipped += brightest == 1;
        }
    }
    const auto pixels = static_cast<double>(picture.pixelCount());
    if (colours.size() < 2) {
        return "is of one colour";
    }
    if (black > kMostBlack * pixels) {
        return fmt::format("is black in {:.0f} % of its pixels", 100 * black / pixels);
    }
    if (clipped > kMostClipped * pixels) {
        return fmt::format("is clipped in {:.0f} % of its pixels", 100 * clipped / pixels);
    }
    return colours.size() < kLeastColours ? fmt::format("has {} colours only", colours.size()) : "";
}

testing::AssertionResult matchesGolden(const fs::path& actual, const GoldenFiles& files)
{
    const Image picture = loadImage(actual);
    const std::string why = whyNoGolden(picture, files.golden);
    if (!why.empty()) {
        return testing::AssertionFailure() << why << "; the picture is " << actual.string();
    }
    const Image golden = loadImage(files.golden);
    const GoldenFigures figures = goldenFigures(picture, golden);
    if (figures.pass()) {
        return testing::AssertionSuccess() << figures.text();
    }
    const std::string drivers = fmt::format("drawn by {}, the golden by {}", readImageAttribute(actual, "Driver"),
                                            readImageAttribute(files.golden, "Driver"));
    keepEvidence(picture, golden, figures.text() + "; " + drivers, files);
    return testing::AssertionFailure() << figures.text() << "; " << drivers << "; actual, golden, difference in "
                                       << files.evidence.string();
}

testing::AssertionResult blessGolden(const fs::path& actual, const GoldenFiles& files)
{
    const Image picture = loadImage(actual);
    const std::string noGuard = whyNoGuard(picture);
    if (!noGuard.empty()) {
        return testing::AssertionFailure() << "not blessed: " << actual.string() << " " << noGuard;
    }
    const std::string why = whyNoGolden(picture, files.golden);
    const std::string change = !fs::exists(files.golden) ? "nothing"
                               : !why.empty()            ? why
                                                         : goldenFigures(picture, loadImage(files.golden)).text();
    fs::copy_file(actual, files.golden, fs::copy_options::overwrite_existing);
    return testing::AssertionFailure() << "blessed " << files.golden.string() << "; before: " << change
                                       << "; test again without NACRE_BLESS";
}

} // namespace nacre::test
