#include "engine/materials/merl_file.h"

#include <cstring>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "engine/brdf/brdf_comparison.h"
#include "tests/support/expect_error.h"
#include "tests/support/models_as_tables.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

constexpr size_t kCells = 90 * 90 * 180;

// A file as MERL's own program reads it: rows of phiD within thetaD within thetaH, the channels one after another.
std::string merlBytes(const std::vector<double>& numbers)
{
    const int32_t shape[3] = {90, 90, 180};
    std::string bytes(sizeof(shape) + numbers.size() * sizeof(double), '\0');
    std::memcpy(bytes.data(), shape, sizeof(shape));
    std::memcpy(bytes.data() + sizeof(shape), numbers.data(), numbers.size() * sizeof(double));
    return bytes;
}

std::vector<double> numbersIn(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    EXPECT_EQ(bytes.size(), 34992012u);
    std::vector<double> numbers(3 * kCells);
    std::memcpy(numbers.data(), bytes.data() + 12, numbers.size() * sizeof(double));
    return numbers;
}

size_t cell(int thetaH, int thetaD, int phiD)
{
    return phiD + 180u * (thetaD + 90u * thetaH);
}

const LambertGgx kGlossy{vec3(0.3f, 0.2f, 0.1f), vec3(0.05f), 0.2f};

TEST(MerlFile, WritesTheModelAtTheCentresOfCells)
{
    const TempFolder folder;
    saveMerl(folder / "a.binary", kGlossy);
    const std::vector<double> numbers = numbersIn(folder / "a.binary");
    // thetaH cell 30 spans sqrt(thetaH/90 deg) from 30/90 to 31/90, and so on.
    const double u = 30.5 / 90;
    const HalfDifference c{static_cast<float>(u * u * M_PI / 2), static_cast<float>(20.5 * M_PI / 180),
                           static_cast<float>(70.5 * M_PI / 180)};
    const LightView d = directionsFromHalfDifference(c);
    const vec3 f = evaluate(kGlossy, {0, 0, 1}, d.l, d.v);
    const double scale[3] = {1500, 1500 / 1.15, 1500 / 1.66};
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(numbers[channel * kCells + cell(30, 20, 70)], f[channel] * scale[channel],
                    1e-5 * f[channel] * scale[channel]); // float angles
    }
    // thetaH of 88 degrees and thetaD of 60: the light or the view is below the horizon.
    EXPECT_EQ(numbers[cell(89, 60, 0)], -1);
    EXPECT_EQ(numbers[2 * kCells + cell(89, 60, 0)], -1);
}

TEST(MerlFile, ComesBackAsTheTableThatItWas)
{
    const TempFolder folder;
    const BrdfModel table = modelOf(tabulatedBrdf(kGlossy));
    saveMerl(folder / "a.binary", table);
    const BrdfModel back = modelOf(loadMerl(folder / "a.binary"));
    // Interpolated twice, to cells of one degree and back to texels of one degree: 54.7 dB and 1.1 % at alpha 0.2.
    const BrdfComparison c = compareBrdfs(functionOf(back), functionOf(table), 50000);
    EXPECT_GT(c.psnr, 53);
    EXPECT_LT(c.percentile95, 0.015);
    EXPECT_EQ(c.configurations, c.outOf);
}

// A function that is linear in the cells' coordinates is met exactly by interpolation, but not if it is shifted by
// half a cell: 0.5/90 of sqrt(thetaH), half a degree of thetaD.
TEST(MerlFile, ResamplesWithoutShift)
{
    std::vector<double> numbers(3 * kCells);
    for (int i = 0; i < 90; ++i) {
        for (int j = 0; j < 90; ++j) {
            for (int k = 0; k < 180; ++k) {
                numbers[cell(i, j, k)] = 1500 * (i + 0.5) / 90;
                numbers[kCells + cell(i, j, k)] = 1500 / 1.15 * (j + 0.5) / 90;
                numbers[2 * kCells + cell(i, j, k)] = 1500 / 1.66 * std::abs(k + 0.5 - 90) / 90;
            }
        }
    }
    const TempFolder folder;
    writeText(folder / "a.binary", merlBytes(numbers));
    const BrdfTable table = loadMerl(folder / "a.binary", {46, 31, 91});
    for (int i = 1; i < 45; ++i) {
        for (int j = 1; j < 30; ++j) {
            for (int k = 1; k < 90; ++k) {
                const vec3 f = table.values[table.index(i, j, k)];
                EXPECT_NEAR(f.x, i / 45.0, 1e-4); // float
                EXPECT_NEAR(f.y, j / 30.0, 1e-4);
                EXPECT_NEAR(f.z, 1 - k / 90.0, 1e-4); // |phiD - 90| / 90 is the same at phiD and 180 - phiD
            }
        }
    }
}

TEST(MerlFile, NegativeIsNotMeasuredAndFilledFromNeighbours)
{
    std::vector<double> numbers(3 * kCells, 150.0);
    for (int i = 40; i < 60; ++i) {
        for (int j = 30; j < 50; ++j) {
            std::fill_n(&numbers[kCells + cell(i, j, 0)], 180, -1.0); // green alone
        }
    }
    const TempFolder folder;
    writeText(folder / "a.binary", merlBytes(numbers));
    const BrdfTable table = loadMerl(folder / "a.binary");
    EXPECT_EQ(table.confidence[table.index(50, 40, 45)], 0);
    EXPECT_EQ(table.confidence[table.index(20, 40, 45)], 1);
    for (const vec3& f : table.values) {
        EXPECT_NEAR(f.x, 0.1f, 1e-6f);
        EXPECT_NEAR(f.y, 0.115f, 1e-6f);
        EXPECT_NEAR(f.z, 0.166f, 1e-6f);
    }
    // And back: where there is no coverage the writer says so.
    saveMerl(folder / "b.binary", modelOf(table));
    const std::vector<double> back = numbersIn(folder / "b.binary");
    EXPECT_EQ(back[cell(50, 40, 90)], -1);
    EXPECT_NEAR(back[cell(20, 40, 90)], 150, 0.01);
}

TEST(MerlFile, WritesNothingBeyondTheTablesDomain)
{
    const TempFolder folder;
    const TableDomain domain{kHalfDifference, kHalfPi / 3};
    saveMerl(folder / "a.binary", modelOf(tabulatedBrdf(kGlossy, {30, 31, 20}, domain)));
    const std::vector<double> numbers = numbersIn(folder / "a.binary");
    EXPECT_GT(numbers[cell(10, 29, 90)], 0);
    EXPECT_EQ(numbers[cell(10, 30, 90)], -1); // 30.5 degrees
}

TEST(MerlFile, RefusesByName)
{
    const TempFolder folder;
    const std::vector<double> numbers(3 * kCells, 1.0);
    const std::string whole = merlBytes(numbers);
    const auto expectRefused = [&](const std::string& bytes, const std::string& fragment) {
        writeText(folder / "bad.binary", bytes);
        expectError([&] { loadMerl(folder / "bad.binary"); }, {"bad.binary", fragment, "90x90x180"});
    };
    expectRefused("", "has 0 bytes");
    expectRefused(whole.substr(0, whole.size() - 8), "cut short");
    expectRefused(whole + "12345678", "too long");
    std::string other = whole;
    const int32_t full = 360;
    std::memcpy(other.data() + 8, &full, sizeof(full));
    expectRefused(other, "shape 90x90x360");
    std::vector<double> broken = numbers;
    broken[7] = std::numeric_limits<double>::quiet_NaN();
    expectRefused(merlBytes(broken), "no number at cell 7");
    expectError([&] { loadMerl(folder / "none.binary"); }, {"none.binary", "cannot be read"});
}

TEST(MerlFile, IsTheSameForAnyNumberOfThreads)
{
    const TempFolder folder;
    saveMerl(folder / "a.binary", kGlossy, 1);
    saveMerl(folder / "b.binary", kGlossy, 3);
    EXPECT_EQ(numbersIn(folder / "a.binary"), numbersIn(folder / "b.binary"));
}

} // namespace
} // namespace nacre
