// The same observations whatever the memory, the threads and the open files.
#include <cstdlib>
#include <utility>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "acquisition/capture/observations.h"
#include "engine/files/error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/write_capture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

// Written by value: gtest prints what differs, and 33 million floats are too many for that.
struct AllObservations {
    std::vector<uint32_t> pixels;
    std::vector<glm::vec3> radiance;
    std::vector<uint8_t> saturated;
    size_t blocks = 0;
    size_t largestBlock = 0; // bytes

    bool sameAs(const AllObservations& other) const
    {
        return pixels == other.pixels && radiance == other.radiance && saturated == other.saturated;
    }
};

AllObservations readAll(ObservationReader& reader)
{
    AllObservations all;
    Observations block;
    while (reader.next(block)) {
        EXPECT_FALSE(block.pixels.empty()); // rows without object make no block
        all.pixels.insert(all.pixels.end(), block.pixels.begin(), block.pixels.end());
        all.radiance.insert(all.radiance.end(), block.radiance.begin(), block.radiance.end());
        all.saturated.insert(all.saturated.end(), block.saturated.begin(), block.saturated.end());
        all.largestBlock =
            std::max(all.largestBlock, block.pixels.size() * sizeof(uint32_t) +
                                           block.radiance.size() * sizeof(glm::vec3) + block.saturated.size());
        ++all.blocks;
    }
    return all;
}

AllObservations readAll(const Capture& capture, int threads, size_t byteBudget)
{
    ObservationReader reader(capture, threads, byteBudget);
    return readAll(reader);
}

Capture writeCapture(const fs::path& folder, int count, int width, int height, const std::string& extension)
{
    Capture capture;
    capture.width = width;
    capture.height = height;
    for (int i = 0; i < count; ++i) {
        const fs::path file = folder / (std::to_string(i) + extension);
        Image picture = testPicture(i, width, height);
        picture.setRgb(width / 2, height / 2, glm::vec3(1)); // one saturated pixel
        writePicture(file, picture);
        capture.photographs.push_back({file.filename().string(), {{file, 1.0}}});
    }
    capture.mask.assign(static_cast<size_t>(width) * height, 0);
    for (int y = 0; y < height; ++y) { // two discs with rows without object above, between and below
        for (int x = 0; x < width; ++x) {
            const double dx = static_cast<double>(x) / width - 0.5;
            const double dy = std::abs(static_cast<double>(y) / height - 0.5) - 0.25;
            capture.mask[static_cast<size_t>(y) * width + x] = dx * dx + dy * dy < 0.04 ? 1 : 0;
        }
    }
    capture.mask[static_cast<size_t>(height / 2) * width + width / 2] = 1;
    return capture;
}

TEST(ObservationsMemorySlow, SameForAllBudgetsAndThreads)
{
    const TempFolder folder;
    const Capture capture = writeCapture(folder.path(), 12, 1000, 700, ".png");
    const AllObservations whole = readAll(capture, 1, ObservationReader::kDefaultByteBudget);
    EXPECT_EQ(whole.blocks, 1u);
    EXPECT_EQ(std::count(whole.saturated.begin(), whole.saturated.end(), 1), 12);
    for (const auto& [megabytes, threads] : {std::pair<size_t, int>{8, 1}, {8, 5}, {16, 2}}) {
        const AllObservations parts = readAll(capture, threads, megabytes << 20);
        EXPECT_TRUE(parts.sameAs(whole)) << megabytes << " MiB, " << threads << " threads";
        EXPECT_LE(parts.largestBlock, megabytes << 20);
        EXPECT_GT(parts.blocks, 1u);
    }
}

TEST(ObservationsMemory, NoBudgetIsARowABlock)
{
    const TempFolder folder;
    const Capture capture = writeCapture(folder.path(), 5, 60, 50, ".png");
    const AllObservations rows = readAll(capture, 2, 1);
    EXPECT_TRUE(rows.sameAs(readAll(capture, 1, ObservationReader::kDefaultByteBudget)));
    EXPECT_GT(rows.blocks, 30u);
}

// Redirects temporary files into a folder that can be looked at.
class ObservationsCopies : public testing::Test {
protected:
    ObservationsCopies()
    {
        if (const char* value = std::getenv("TMPDIR")) {
            before_ = value;
        }
        setenv("TMPDIR", temporary_.path().c_str(), 1);
    }
    ~ObservationsCopies() override { before_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before_.c_str(), 1); }
    size_t copies() const
    {
        const fs::recursive_directory_iterator files(temporary_.path());
        return std::count_if(begin(files), end(files), [](const auto& entry) { return entry.is_regular_file(); });
    }
    TempFolder folder_;
    TempFolder temporary_;
    std::string before_;
};

TEST_F(ObservationsCopies, PicturesThatCannotBeStreamedAreCopiedAndReadTheSame)
{
    for (const std::string extension : {".tga", ".dpx", ".hdr"}) { // 8 bits, 16 bits, floats
        Capture capture = writeCapture(folder_ / extension, 4, 100, 75, extension);
        for (const TransferCurve& curve : {TransferCurve::linear, TransferCurve::srgb}) {
            capture.curve = curve;
            const AllObservations whole = readAll(capture, 2, ObservationReader::kDefaultByteBudget);
            EXPECT_EQ(copies(), 0u);
            {
                ObservationReader reader(capture, 2, 50'000); // a picture is 90 kB
                EXPECT_EQ(copies(), 4u) << extension;
                const AllObservations parts = readAll(reader);
                EXPECT_GT(parts.blocks, 1u);
                EXPECT_TRUE(parts.sameAs(whole)) << extension;
            }
            EXPECT_TRUE(fs::is_empty(temporary_.path()));
        }
    }
}

TEST_F(ObservationsCopies, AreReadInPlaceOfTheFiles)
{
    const Capture capture = writeCapture(folder_.path(), 4, 200, 150, ".tga");
    const AllObservations whole = readAll(capture, 2, ObservationReader::kDefaultByteBudget);
    ObservationReader reader(capture, 2, 100'000);
    for (const Photograph& photograph : capture.photographs) {
        fs::resize_file(photograph.exposures[0].file, 100);
    }
    EXPECT_TRUE(readAll(reader).sameAs(whole));
}

TEST_F(ObservationsCopies, PicturesThatFitAreHeld)
{
    Capture capture = writeCapture(folder_.path(), 4, 200, 150, ".tga");
    capture.mask.assign(capture.mask.size(), 1);
    const AllObservations whole = readAll(capture, 2, ObservationReader::kDefaultByteBudget);
    ObservationReader reader(capture, 2, 1'500'000); // half of it holds two pictures
    EXPECT_EQ(copies(), 2u);
    EXPECT_TRUE(readAll(reader).sameAs(whole));
}

TEST_F(ObservationsCopies, AreRemovedWhereReadingFails)
{
    const Capture capture = writeCapture(folder_.path(), 4, 200, 150, ".tga");
    writeText(folder_ / "3.tga", "no picture");
    EXPECT_ANY_THROW(readAll(capture, 2, 100'000));
    EXPECT_TRUE(fs::is_empty(temporary_.path()));
}

TEST_F(ObservationsCopies, NoPlaceForThemIsAnError)
{
    const Capture capture = writeCapture(folder_.path(), 4, 200, 150, ".tga");
    setenv("TMPDIR", (temporary_ / "nowhere").c_str(), 1);
    EXPECT_THROW(readAll(capture, 2, 100'000), Error);
}

TEST(ObservationsOpenFiles, FewAllowedFilesAreEnough)
{
    const TempFolder folder;
    const Capture capture = writeCapture(folder.path(), 60, 40, 30, ".png");
    const AllObservations whole = readAll(capture, 1, ObservationReader::kDefaultByteBudget);
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &limit), 0);
    const fs::directory_iterator openFiles("/proc/self/fd");
    rlimit few = limit;
    few.rlim_cur = std::distance(begin(openFiles), end(openFiles)) + 40; // fewer than photographs
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
    AllObservations parts;
    EXPECT_NO_THROW(parts = readAll(capture, 2, 150'000));
    setrlimit(RLIMIT_NOFILE, &limit);
    EXPECT_GT(parts.blocks, 1u);
    EXPECT_TRUE(parts.sameAs(whole));
}

} // namespace
} // namespace nacre
