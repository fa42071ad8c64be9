// Relightable pictures of others: the fit, and what their files keep of it.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "engine/rti/ptm_file.h"
#include "engine/rti/rti_web.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

namespace nacre {
namespace {

constexpr int kWidth = 24, kHeight = 16;

// Terms between -0.3 and 0.3 about a bright constant, that tell rows, columns, channels and terms apart.
RtiPicture knownPicture(RtiBasis basis)
{
    RtiPicture picture{basis, std::vector<Image>(rtiTermCount(basis), Image(kWidth, kHeight, 3))};
    for (size_t k = 0; k < picture.terms.size(); ++k) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const double phase = 0.2 * x - 0.15 * y + 0.9 * c + 1.7 * static_cast<double>(k);
                    picture.terms[k].at(x, y, c) =
                        static_cast<float>((k == 0 ? 0.5 : 0.0) + 0.3 * std::sin(phase) / (1.0 + k));
                }
            }
        }
    }
    return picture;
}

// One colour a pixel, times one biquadratic.
RtiPicture colouredPicture()
{
    RtiPicture picture = knownPicture(RtiBasis::ptm);
    for (Image& term : picture.terms) {
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const float grey = term.at(x, y, 1);
                term.setRgb(x, y, grey * glm::vec3(1.0f, x / 48.0f, y / 32.0f));
            }
        }
    }
    return picture;
}

float largestDifference(const RtiPicture& a, const RtiPicture& b)
{
    float largest = 0;
    for (size_t k = 0; k < a.terms.size(); ++k) {
        for (size_t i = 0; i < a.terms[k].values.size(); ++i) {
            largest = std::max(largest, std::abs(a.terms[k].values[i] - b.terms[k].values[i]));
        }
    }
    return largest;
}

Image unroundedSum(const RtiPicture& picture, const glm::vec3& light)
{
    const std::vector<double> weights = rtiWeights(picture.basis, light);
    Image sum(kWidth, kHeight, 3);
    for (size_t k = 0; k < weights.size(); ++k) {
        for (size_t i = 0; i < sum.values.size(); ++i) {
            sum.values[i] += static_cast<float>(weights[k]) * picture.terms[k].values[i];
        }
    }
    return sum;
}

// The 8-bit codes that `relit` rounds to differ from the sum by at most half of one.
TEST(Rti, RelitIsTheSumOfTheTermsRoundedAndClipped)
{
    const RtiPicture picture = knownPicture(RtiBasis::hsh);
    const glm::vec3 light = glm::normalize(glm::vec3(0.5f, -0.3f, 0.8f));
    const Image sum = unroundedSum(picture, light), codes = relit(picture, light);
    for (size_t i = 0; i < sum.values.size(); ++i) {
        EXPECT_NEAR(codes.values[i], std::clamp(sum.values[i], 0.0f, 1.0f), 0.5 / 255 + 1e-6);
    }
}

TEST(Rti, FittingGivesTheTermsBack)
{
    for (const RtiBasis basis : {RtiBasis::ptm, RtiBasis::hsh}) {
        const RtiPicture truth = knownPicture(basis);
        const auto fits =
            fitRti([&](const glm::vec3& light) { return unroundedSum(truth, light); }, {{basis}}, rtiLights(40));
        ASSERT_EQ(fits.size(), 1u);
        // Forty sums of floats below 2, times an inverse of a condition below 100.
        EXPECT_LT(largestDifference(fits[0], truth), 1e-4f) << rtiBasisName(basis);
    }
}

// Over the whole hemisphere the harmonics are orthonormal: means of products over its solid angle, times 2 pi.
TEST(Rti, HemisphericalHarmonicsAreOrthonormal)
{
    constexpr int kSteps = 128;
    std::vector<std::vector<double>> sums(9, std::vector<double>(9, 0.0));
    for (int i = 0; i < kSteps; ++i) {
        for (int j = 0; j < kSteps; ++j) {
            const double z = 0.15 + 0.85 * (i + 0.5) / kSteps; // above the lowest light
            const double phi = 2 * M_PI * (j + 0.5) / kSteps, r = std::sqrt(1 - z * z);
            const auto w = rtiWeights(RtiBasis::hsh, glm::vec3(r * std::cos(phi), r * std::sin(phi), z));
            for (size_t a = 0; a < 9; ++a) {
                for (size_t b = 0; b < 9; ++b) {
                    sums[a][b] += w[a] * w[b] * 2 * M_PI * 0.85 / (kSteps * kSteps);
                }
            }
        }
    }
    // Functions of different azimuth stay orthogonal in the part above the lowest light; 1 and sin phi, say.
    EXPECT_NEAR(sums[0][1], 0, 1e-6);
    EXPECT_NEAR(sums[1][3], 0, 1e-6);
    EXPECT_NEAR(sums[4][8], 0, 1e-6);
    EXPECT_NEAR(sums[0][0], 0.85, 1e-6); // 1 / (2 pi) over 0.85 of the solid angle
    EXPECT_GT(sums[8][8], 0.5);
    EXPECT_LT(sums[8][8], 1.0);
    EXPECT_NEAR(sums[4][4], sums[8][8], 1e-6); // cosine and sine of one term
}

TEST(Rti, PtmBytesComeBackAndCostHalfAStep)
{
    const TempFolder folder;
    const RtiPicture truth = knownPicture(RtiBasis::ptm);
    const PtmFile ptm = ptmFromRti(truth, PtmFormat::rgb);
    savePtm(folder / "a.ptm", ptm);
    const PtmFile read = loadPtm(folder / "a.ptm");
    EXPECT_EQ(read.coefficients, ptm.coefficients);
    EXPECT_EQ(read.bias, ptm.bias);
    EXPECT_EQ(read.scale, ptm.scale);
    float largestScale = 0;
    for (const float scale : read.scale) {
        largestScale = std::max(largestScale, scale);
    }
    // The rounding of the value and that of the bias at the end of the range.
    EXPECT_LT(largestDifference(rtiFromPtm(read), truth), 1.01f * largestScale / 255);
    EXPECT_LT(largestScale, 2.5f); // codes of terms that span 0.9: 0.9 * 255 / 255
}

// What other programs rely on: the header's lines, and that the f-th pixel from the bottom left, to the right and up,
// has its f-th byte in red's block where it has the f-th of x^2, y^2, xy, x, y, 1 alone.
TEST(Rti, PtmLayoutIsTheFormats)
{
    const TempFolder folder;
    RtiPicture picture{RtiBasis::ptm, std::vector<Image>(6, Image(3, 2, 3))};
    picture.terms[3].setRgb(0, 1, {1.0f, 0.5f, 0.25f});
    picture.terms[5].setRgb(1, 1, glm::vec3(1.0f));
    picture.terms[4].setRgb(2, 1, glm::vec3(1.0f));
    picture.terms[1].setRgb(0, 0, glm::vec3(1.0f));
    picture.terms[2].setRgb(1, 0, glm::vec3(1.0f));
    picture.terms[0].setRgb(2, 0, glm::vec3(-1.0f)); // of a range from -1 to 0: code 0, and 255 elsewhere
    savePtm(folder / "rgb.ptm", ptmFromRti(picture, PtmFormat::rgb));
    const std::string text = readTextFile(folder / "rgb.ptm");
    const std::string header = "PTM_1.2\nPTM_FORMAT_RGB\n3\n2\n1 1 1 1 1 1\n0 0 0 0 0 255\n";
    ASSERT_EQ(text.substr(0, header.size()), header);
    ASSERT_EQ(text.size() - header.size(), 3u * 6 * 6);
    const auto byte = [&](size_t i) { return static_cast<int>(static_cast<uint8_t>(text[header.size() + i])); };
    for (size_t pixel = 0; pixel < 6; ++pixel) {
        for (size_t k = 0; k < 6; ++k) {
            EXPECT_EQ(byte(6 * pixel + k), (pixel == k) != (k == 5) ? 255 : 0) << pixel << ' ' << k;
        }
    }
    EXPECT_EQ(byte(36), 128); // green's block
    EXPECT_EQ(byte(72), 64);  // blue's
}

TEST(Rti, LrgbKeepsOneColourAPixel)
{
    const TempFolder folder;
    const RtiPicture truth = colouredPicture();
    savePtm(folder / "a.ptm", ptmFromRti(truth, PtmFormat::lrgb));
    const std::string text = readTextFile(folder / "a.ptm");
    EXPECT_EQ(text.substr(0, 24), "PTM_1.2\nPTM_FORMAT_LRGB\n");
    // A step of the coefficients' 256, and half a code of a colour times coefficients up to 0.8.
    EXPECT_LT(largestDifference(rtiFromPtm(loadPtm(folder / "a.ptm")), truth), 1.01f * 0.9f / 255 + 0.8f * 0.5f / 255);
}

TEST(Rti, LrgbOfSeveralColoursIsNearerThanTheMeanColour)
{
    const RtiPicture truth = knownPicture(RtiBasis::ptm);
    const auto under = [&](const glm::vec3& light) { return relit(truth, light); };
    const std::vector<uint8_t> all(size_t{kWidth} * kHeight, 1);
    const double nearest = rtiPsnr(rtiFromPtm(ptmFromRti(truth, PtmFormat::lrgb)), under, rtiCheckLights(), all);
    RtiPicture grey = truth; // the channels' mean
    for (Image& term : grey.terms) {
        for (size_t i = 0; i < term.values.size(); i += 3) {
            const float mean = (term.values[i] + term.values[i + 1] + term.values[i + 2]) / 3;
            term.values[i] = term.values[i + 1] = term.values[i + 2] = mean;
        }
    }
    EXPECT_GT(nearest, rtiPsnr(grey, under, rtiCheckLights(), all) + 2);
    // With a biquadratic a channel only the quantisation is left.
    EXPECT_GT(rtiPsnr(rtiFromPtm(ptmFromRti(truth, PtmFormat::rgb)), under, rtiCheckLights(), all), 45);
}

TEST(Rti, WebPicturesComeBackButForJpegsLoss)
{
    for (const RtiBasis basis : {RtiBasis::ptm, RtiBasis::hsh}) {
        const TempFolder folder;
        const RtiPicture truth = knownPicture(basis);
        saveRtiWeb(folder.path(), truth, rtiLights(20));
        const RtiPicture read = loadRtiWeb(folder.path());
        EXPECT_EQ(read.basis, basis);
        ASSERT_EQ(read.terms.size(), truth.terms.size());
        // Smooth pictures at quality 95: a few codes of 255 of a range of 0.9.
        EXPECT_LT(largestDifference(read, truth), 0.03f);
        EXPECT_TRUE(std::filesystem::exists(folder / fmt::format("plane_{}.jpg", rtiTermCount(basis) - 1)));
        EXPECT_FALSE(std::filesystem::exists(folder / fmt::format("plane_{}.jpg", rtiTermCount(basis))));
    }
}

TEST(Rti, BadPtmFilesAreRefused)
{
    const TempFolder folder;
    const std::filesystem::path file = folder / "bad.ptm";
    savePtm(file, ptmFromRti(knownPicture(RtiBasis::ptm), PtmFormat::lrgb));
    const std::string good = readTextFile(file);
    const auto refused = [&](const std::string& text, const std::vector<std::string>& fragments) {
        writeText(file, text);
        expectError([&] { loadPtm(file); }, fragments);
    };
    const auto replaced = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    refused(good.substr(0, good.size() - 1), {"bad.ptm", "bytes after its header"});
    refused(good + "x", {"bytes after its header"});
    refused(good.substr(0, 30), {"ends in its header"});
    refused("", {"ends in its header"});
    refused(replaced("PTM_1.2", "PTM_1.1"), {"PTM_1.1", "PTM_1.2"});
    refused(replaced("LRGB", "JPEG_LRGB"), {"PTM_FORMAT_JPEG_LRGB"});
    refused(replaced("24\n16", "-4\n16"), {"-4 x 16"});
    refused(replaced("24\n16", "24\nsixteen"), {"sixteen"});
    refused(replaced("24\n16\n", "24\n16\nnan "), {"no number"});
    expectError([&] { loadPtm(folder / "none.ptm"); }, {"none.ptm", "cannot be read"});
}

TEST(Rti, BadWebFoldersAreRefused)
{
    const TempFolder folder;
    saveRtiWeb(folder.path(), knownPicture(RtiBasis::ptm), rtiLights(20));
    const std::string good = readTextFile(folder / "info.json");
    const auto refused = [&](const std::string& from, const std::string& to, const std::string& fragment) {
        std::string text = good;
        writeText(folder / "info.json", text.replace(text.find(from), from.size(), to));
        expectError([&] { loadRtiWeb(folder.path()); }, {fragment});
    };
    refused("\"ptm\"", "\"rbf\"", "rbf");
    refused("\"nplanes\": 18", "\"nplanes\": 27", "27 planes");
    refused("\"width\": 24", "\"width\": 23", "plane_0.jpg");
    refused("\"scale\"", "\"scales\"", "materials[0] lacks \"scale\"");
    writeText(folder / "info.json", good);
    std::filesystem::remove(folder / "plane_3.jpg");
    expectError([&] { loadRtiWeb(folder.path()); }, {"plane_3.jpg", "does not exist"});
}

} // namespace
} // namespace nacre
