// Between polynomials per channel and the bytes of a .ptm file.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/rti/ptm_file.h"

namespace nacre {

namespace {

constexpr size_t kTerms = PtmFile::kTerms;
constexpr float kFullScale = 255;
// The file's x^2, y^2, xy, x, y, 1 as indices into 1, x, y, x^2, xy, y^2.
constexpr std::array<size_t, kTerms> kTermOf = {3, 5, 4, 1, 2, 0};
constexpr int kPowerSteps = 24; // brings even two channels' colours of 0.8 times the power to 1 % of each other

using Polynomial = std::array<glm::vec3, kTerms>; // RGB a term, in the order of RtiPicture

Polynomial polynomialAt(const RtiPicture& picture, size_t pixel)
{
    Polynomial polynomial;
    for (size_t k = 0; k < kTerms; ++k) {
        const float* p = &picture.terms[k].values[3 * pixel];
        polynomial[k] = {p[0], p[1], p[2]};
    }
    return polynomial;
}

// Mean over the unit disc of the product of terms i and j.
double momentOf(size_t i, size_t j)
{
    constexpr std::array<std::pair<int, int>, kTerms> kPowers = {{{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}}};
    const int x = kPowers[i].first + kPowers[j].first, y = kPowers[i].second + kPowers[j].second;
    if (x % 2 != 0 || y % 2 != 0) {
        return 0;
    }
    if (x + y == 0) {
        return 1;
    }
    return x + y == 2 ? 1.0 / 4 : (x == 2 ? 1.0 / 24 : 1.0 / 8);
}

// The channels' products with each other, over the disc.
glm::dmat3 gramOf(const Polynomial& polynomial)
{
    glm::dmat3 gram(0);
    for (size_t i = 0; i < kTerms; ++i) {
        for (size_t j = 0; j < kTerms; ++j) {
            const double moment = momentOf(i, j);
            if (moment != 0) {
                gram += moment * glm::outerProduct(glm::dvec3(polynomial[i]), glm::dvec3(polynomial[j]));
            }
        }
    }
    return gram;
}

// The eigenvector of the largest eigenvalue, by power iteration: polynomial = luminance x colour is nearest with it
// (Eckart and Young 1936). Its largest channel is 1; black where all is black.
glm::vec3 colourOf(const Polynomial& polynomial)
{
    const glm::dmat3 gram = gramOf(polynomial);
    glm::dvec3 colour(1);
    for (int step = 0; step < kPowerSteps; ++step) {
        colour = glm::max(gram * colour, glm::dvec3(0));
        const double largest = std::max({colour.x, colour.y, colour.z});
        if (!(largest > 0)) {
            return glm::vec3(0);
        }
        colour /= largest;
    }
    return glm::vec3(colour);
}

// Codes of the three channels' coefficients before quantisation: kTerms a pixel and block.
std::vector<float> channelBlocks(const RtiPicture& picture)
{
    const size_t pixels = picture.terms[0].pixelCount();
    std::vector<float> values(3 * kTerms * pixels);
    for (size_t c = 0; c < 3; ++c) {
        for (size_t pixel = 0; pixel < pixels; ++pixel) {
            for (size_t k = 0; k < kTerms; ++k) {
                values[(c * pixels + pixel) * kTerms + k] =
                    kFullScale * picture.terms[kTermOf[k]].values[3 * pixel + c];
            }
        }
    }
    return values;
}

// The same of one luminance, with the colours beside it.
std::vector<float> luminanceBlock(const RtiPicture& picture, std::vector<uint8_t>& colours)
{
    const size_t pixels = picture.terms[0].pixelCount();
    std::vector<float> values(kTerms * pixels, 0.0f);
    colours.resize(3 * pixels, 0);
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        const Polynomial polynomial = polynomialAt(picture, pixel);
        const glm::vec3 codes = glm::round(kFullScale * colourOf(polynomial));
        const glm::vec3 colour = codes / kFullScale;
        const float power = glm::dot(colour, colour);
        for (size_t k = 0; k < kTerms && power > 0; ++k) {
            values[pixel * kTerms + k] = kFullScale * glm::dot(polynomial[kTermOf[k]], colour) / power;
        }
        for (int c = 0; c < 3; ++c) {
            colours[3 * pixel + c] = static_cast<uint8_t>(codes[c]);
        }
    }
    return values;
}

// 0 is always in the range, so that a pixel without the object is exactly black.
void quantise(const std::vector<float>& values, PtmFile& ptm)
{
    ptm.coefficients.resize(values.size());
    for (size_t k = 0; k < kTerms; ++k) {
        float low = 0, high = 0;
        for (size_t i = k; i < values.size(); i += kTerms) {
            low = std::min(low, values[i]);
            high = std::max(high, values[i]);
        }
        ptm.scale[k] = high > low ? (high - low) / kFullScale : 1;
        ptm.bias[k] = static_cast<int>(std::round(-low / ptm.scale[k]));
        for (size_t i = k; i < values.size(); i += kTerms) {
            const float code = std::round(values[i] / ptm.scale[k]) + static_cast<float>(ptm.bias[k]);
            ptm.coefficients[i] = static_cast<uint8_t>(std::clamp(code, 0.0f, kFullScale));
        }
    }
}

} // namespace

PtmFile ptmFromRti(const RtiPicture& picture, PtmFormat format)
{
    PtmFile ptm;
    ptm.format = format;
    ptm.width = picture.width();
    ptm.height = picture.height();
    quantise(format == PtmFormat::rgb ? channelBlocks(picture) : luminanceBlock(picture, ptm.colours), ptm);
    return ptm;
}

RtiPicture rtiFromPtm(const PtmFile& ptm)
{
    RtiPicture picture{RtiBasis::ptm, std::vector<Image>(kTerms, Image(ptm.width, ptm.height, 3))};
    const size_t pixels = picture.terms[0].pixelCount();
    for (size_t k = 0; k < kTerms; ++k) {
        for (size_t i = 0; i < 3 * pixels; ++i) {
            const size_t pixel = i / 3, block = ptm.format == PtmFormat::rgb ? i % 3 : 0;
            const int code = ptm.coefficients[(block * pixels + pixel) * kTerms + k];
            const float value = static_cast<float>(code - ptm.bias[k]) * ptm.scale[k] / kFullScale;
            const float colour = ptm.format == PtmFormat::rgb ? 1 : static_cast<float>(ptm.colours[i]) / kFullScale;
            picture.terms[kTermOf[k]].values[i] = value * colour;
        }
    }
    return picture;
}

} // namespace nacre
