#include "engine/materials/ktx2_file.h"

#include <cstring>
#include <fstream>

#include <glm/gtc/packing.hpp>
#include <gtest/gtest.h>

#include "engine/brdf/brdf_tabulation.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

// Fields by their offsets in Khronos' specification; tests/ktx has it read by a parser that is not ours.
class Ktx2Test : public testing::Test {
protected:
    void write(const BrdfTable& table)
    {
        clamped_ = saveKtx2(folder_ / "a.ktx2", table);
        std::ifstream stream(folder_ / "a.ktx2", std::ios::binary);
        bytes_ = std::string(std::istreambuf_iterator<char>(stream), {});
    }
    template <class T> T at(size_t offset) const
    {
        T value;
        EXPECT_LE(offset + sizeof(T), bytes_.size());
        std::memcpy(&value, bytes_.data() + offset, sizeof(T));
        return value;
    }

    TempFolder folder_;
    std::string bytes_;
    size_t clamped_ = 0;
};

TEST_F(Ktx2Test, HeaderAndIndexFitTheFile)
{
    write(tabulatedBrdf(LambertGgx{}, {7, 5, 3}, {kHalfDifference, 0.5f}));
    EXPECT_EQ(bytes_.substr(0, 12), "\xABKTX 20\xBB\r\n\x1A\n");
    EXPECT_EQ(at<uint32_t>(12), 97u); // VK_FORMAT_R16G16B16A16_SFLOAT
    EXPECT_EQ(at<uint32_t>(16), 2u);  // bytes of a channel
    EXPECT_EQ(at<uint32_t>(20), 7u);
    EXPECT_EQ(at<uint32_t>(24), 5u);
    EXPECT_EQ(at<uint32_t>(28), 3u);
    EXPECT_EQ(at<uint32_t>(32), 0u); // no array
    EXPECT_EQ(at<uint32_t>(36), 1u); // no cube
    EXPECT_EQ(at<uint32_t>(40), 1u); // one level
    const auto descriptorAt = at<uint32_t>(48), descriptorBytes = at<uint32_t>(52);
    EXPECT_EQ(descriptorAt, 104u); // right behind the index of one level
    EXPECT_EQ(at<uint32_t>(descriptorAt), descriptorBytes);
    const auto levelAt = at<uint64_t>(80), levelBytes = at<uint64_t>(88);
    EXPECT_EQ(levelAt % 8, 0u);
    EXPECT_EQ(levelBytes, 7u * 5 * 3 * 8);
    EXPECT_EQ(levelAt + levelBytes, bytes_.size());
    const std::string keys = bytes_.substr(at<uint32_t>(56), at<uint32_t>(60));
    EXPECT_LT(keys.find("KTXwriter"), keys.find("nacre:brdfTable"));
    EXPECT_NE(keys.find("1 7 5 3 half-difference 0.5"), std::string::npos);
}

TEST_F(Ktx2Test, TexelsAreTheTables)
{
    BrdfTable table = tabulatedBrdf(LambertGgx{{0.4f, 0.2f, 0.1f}, vec3(0.05f), 0.2f}, {6, 5, 4});
    table.confidence[17] = 0.25f;
    write(table);
    const size_t levelAt = at<uint64_t>(80);
    for (size_t i = 0; i < table.values.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            const float expected = c < 3 ? table.values[i][c] : table.confidence[i];
            // Eleven bits of mantissa.
            EXPECT_NEAR(glm::unpackHalf1x16(at<uint16_t>(levelAt + 8 * i + 2 * c)), expected, expected / 2000);
        }
    }
    EXPECT_EQ(clamped_, 0u);
}

TEST_F(Ktx2Test, ClampsAndCountsWhatHalfCannotHold)
{
    BrdfTable table({2, 2, 2}, {kNatural, kHalfPi});
    table.values[3] = {1e6f, 70000, 65504};
    write(table);
    EXPECT_EQ(clamped_, 2u);
    EXPECT_EQ(glm::unpackHalf1x16(at<uint16_t>(at<uint64_t>(80) + 24)), 65504);
}

} // namespace
} // namespace nacre
