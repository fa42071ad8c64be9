// Curves of ICC profiles against the formulas that they state, and what files say of theirs.
#include <cmath>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "engine/files/icc_profile.h"
#include "engine/files/image.h"
#include "shared/shading.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

using Bytes = std::string;

Bytes number(uint32_t value, size_t bytes)
{
    Bytes text;
    for (size_t i = bytes; i-- > 0;) {
        text += static_cast<char>(value >> 8 * i & 0xff);
    }
    return text;
}

Bytes fixed(double value)
{
    return number(static_cast<uint32_t>(static_cast<int32_t>(std::lround(value * 65536))), 4);
}

Bytes para(int type, const std::vector<double>& parameters)
{
    Bytes text = "para" + number(0, 4) + number(static_cast<uint32_t>(type), 2) + number(0, 2);
    for (const double parameter : parameters) {
        text += fixed(parameter);
    }
    return text;
}

Bytes curv(const std::vector<uint32_t>& entries)
{
    Bytes text = "curv" + number(0, 4) + number(static_cast<uint32_t>(entries.size()), 4);
    for (const uint32_t entry : entries) {
        text += number(entry, 2);
    }
    return text;
}

Bytes xyz(double x, double y, double z)
{
    return "XYZ " + number(0, 4) + fixed(x) + fixed(y) + fixed(z);
}

Bytes profileOf(const Bytes& curve, const Bytes& red = xyz(0.4361, 0.2225, 0.0139))
{
    const uint32_t first = 128 + 4 + 2 * 12;
    const auto size = [](const Bytes& bytes) { return static_cast<uint32_t>(bytes.size()); };
    return Bytes(128, 0) + number(2, 4) + "rXYZ" + number(first, 4) + number(size(red), 4) + "gTRC" +
           number(first + size(red), 4) + number(size(curve), 4) + red + curve;
}

std::optional<IccColour> colourOf(const Bytes& profile)
{
    return readIccProfile({reinterpret_cast<const unsigned char*>(profile.data()), profile.size()});
}

void expectCurve(const Bytes& element, const std::function<double(double)>& truth)
{
    const auto colour = colourOf(profileOf(element));
    ASSERT_TRUE(colour);
    for (int i = 0; i <= 1000; ++i) {
        const double x = i / 1000.0;
        float value = static_cast<float>(x);
        decodeCurve({&value, 1}, colour->curve);
        EXPECT_NEAR(value, truth(x), 2e-5) << x << " of " << colour->curve.name;
    }
}

TEST(IccProfile, FormulasAndTablesAreWhatTheyState)
{
    expectCurve(curv({}), [](double x) { return x; });
    expectCurve(curv({0x0180}), [](double x) { return std::pow(x, 1.5); });
    std::vector<uint32_t> table;
    for (int i = 0; i < 1024; ++i) {
        table.push_back(static_cast<uint32_t>(std::lround(65535 * std::pow(i / 1023.0, 1.8))));
    }
    expectCurve(curv(table), [](double x) { return std::pow(x, 1.8); });
    expectCurve(para(0, {1.8}), [](double x) { return std::pow(x, 1.8); });
    expectCurve(para(1, {2, 1.25, -0.25}), [](double x) { return x < 0.2 ? 0 : std::pow(1.25 * x - 0.25, 2); });
    expectCurve(para(2, {2, 0.75, -0.15, 0.25}),
                [](double x) { return 0.25 + (x < 0.2 ? 0 : std::pow(0.75 * x - 0.15, 2)); });
    expectCurve(para(3, {3, 0.8620689, 0.1379310, 0.1107, 0.08}), // CIE L*, in the form of ProPhoto's kin
                [](double x) { return x < 0.08 ? 0.1107 * x : std::pow(0.8620689 * x + 0.1379310, 3); });
    expectCurve(para(4, {2, 0.875, 0, 0.5, 0.5, 0.125, 0.0}),
                [](double x) { return x < 0.5 ? 0.5 * x : std::pow(0.875 * x, 2) + 0.125; });
}

TEST(IccProfile, KnownCurvesAreKnown)
{
    EXPECT_EQ(colourOf(profileOf(para(3, {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045})))->curve,
              TransferCurve::srgb);
    EXPECT_EQ(colourOf(profileOf(curv({})))->curve, TransferCurve::linear);
    EXPECT_FALSE(colourOf(profileOf(curv({})))->hasOtherPrimaries);
    EXPECT_TRUE(colourOf(profileOf(curv({}), xyz(0.6097, 0.3111, 0.0195)))->hasOtherPrimaries); // Adobe RGB
}

// Whatever is cut off or turned over, something or nothing is read, and nothing outside.
TEST(IccProfile, DamageIsNoCurve)
{
    const Bytes whole = profileOf(curv({0, 100, 65535}));
    for (size_t size = 0; size < whole.size(); ++size) {
        EXPECT_FALSE(colourOf(whole.substr(0, size)));
    }
    for (size_t i = 0; i < whole.size(); ++i) {
        Bytes damaged = whole;
        damaged[i] = static_cast<char>(~damaged[i]);
        colourOf(damaged);
    }
    EXPECT_FALSE(colourOf(profileOf(curv({65535, 0}))));
    EXPECT_FALSE(colourOf(profileOf("mft2" + Bytes(60, 1))));
}

TEST(ImageFiles, JpegsThatDeclareNothingAreTakenAsSrgb)
{
    const TempFolder folder;
    const Image picture(8, 8, 3, 0.5f);
    saveImage(folder / "a.jpg", picture, PixelType::uint8);
    std::string bytes; // without what the writer says: markers APP1 to APP15
    std::ifstream stream(folder / "a.jpg", std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
    for (size_t at = 2; static_cast<unsigned char>(bytes[at + 1]) != 0xda;) {
        const auto marker = static_cast<unsigned char>(bytes[at + 1]);
        const size_t size =
            2 + (static_cast<unsigned char>(bytes[at + 2]) << 8 | static_cast<unsigned char>(bytes[at + 3]));
        marker > 0xe0 && marker <= 0xef ? static_cast<void>(bytes.erase(at, size)) : static_cast<void>(at += size);
    }
    writeText(folder / "bare.jpg", bytes);
    EXPECT_FALSE(readImageHeader(folder / "bare.jpg").curveIsDeclared);
    EXPECT_EQ(readImageHeader(folder / "bare.jpg").curve, TransferCurve::srgb);
    EXPECT_NEAR(loadPhotograph(folder / "bare.jpg", readImageHeader(folder / "bare.jpg").curve).values[0],
                linearFromSrgb(0.5f), 0.01f);
    // EXIF: ColorSpace 65535, which cameras say of Adobe RGB with R03, others of anything.
    using namespace std::string_literals;
    const std::string exif = "Exif\0\0II*\0\x08\0\0\0\x01\0\x69\x87\x04\0\x01\0\0\0\x1a\0\0\0\0\0\0\0"s
                             "\x02\0\x01\xa0\x03\0\x01\0\0\0\xff\xff\0\0\x05\xa0\x04\0\x01\0\0\0\x38\0\0\0\0\0\0\0"s
                             "\x01\0\x01\0\x02\0\x04\0\0\0R03\0\0\0\0\0"s;
    const auto headerWith = [&](const std::string& segment) {
        writeText(folder / "a.jpg", bytes.substr(0, 2) + "\xff\xe1" +
                                        number(static_cast<uint32_t>(segment.size() + 2), 2) + segment +
                                        bytes.substr(2));
        return readImageHeader(folder / "a.jpg");
    };
    const ImageHeader adobe = headerWith(exif);
    EXPECT_TRUE(adobe.curveIsDeclared);
    float half = 0.5f;
    decodeCurve({&half, 1}, adobe.curve);
    EXPECT_NEAR(half, std::pow(0.5, 563.0 / 256), 1e-6); // Adobe RGB (1998), 4.3.4.2
    EXPECT_NE(adobe.otherColours, "");
    std::string unnamed = exif;
    unnamed[unnamed.find("R03")] = '?';
    EXPECT_FALSE(headerWith(unnamed).curveIsDeclared);
    EXPECT_EQ(headerWith(unnamed).curve, TransferCurve::srgb);
    EXPECT_NE(headerWith(unnamed).otherColours, "");
    EXPECT_EQ(readImageHeader(folder / "bare.jpg").otherColours, "");
}

} // namespace
} // namespace nacre
