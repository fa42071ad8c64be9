#include "engine/rti/ptm_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

constexpr const char* kPtmVersion = "PTM_1.2";
constexpr int kLargestSide = 1 << 16;

// The size of a row's bytes in each block, in the file's order; the file begins with the bottom row of each block.
std::vector<uint8_t> flippedRows(const std::vector<uint8_t>& block, size_t rowBytes, int height)
{
    std::vector<uint8_t> flipped;
    flipped.reserve(block.size());
    const size_t rows = block.size() / rowBytes;
    for (size_t row = 0; row < rows; ++row) {
        const size_t picture = row / height * height; // first row of this row's picture
        const auto from = block.begin() + static_cast<std::ptrdiff_t>((picture + height - 1 - row % height) * rowBytes);
        flipped.insert(flipped.end(), from, from + static_cast<std::ptrdiff_t>(rowBytes));
    }
    return flipped;
}

// Words between white space, as the header has them.
class Header {
public:
    Header(const std::filesystem::path& file, std::string_view text) : file_(file), text_(text) {}

    std::string_view word(const char* expected)
    {
        const size_t first = text_.find_first_not_of(" \t\r\n", at_);
        const size_t last = first == text_.npos ? first : text_.find_first_of(" \t\r\n", first);
        if (last == text_.npos) {
            throw Error(file_, "ends in its header", expected);
        }
        at_ = last;
        return text_.substr(first, last - first);
    }

    template <class Number> Number number(const char* expected)
    {
        const std::string_view digits = word(expected);
        Number value{};
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (problem != std::errc() || end != digits.data() + digits.size()) {
            throw Error(file_, fmt::format("has '{}' in its header", digits), expected);
        }
        return value;
    }

    // The binary part begins after the line's end.
    std::string_view rest()
    {
        const size_t end = text_.find('\n', at_);
        return end == text_.npos ? std::string_view() : text_.substr(end + 1);
    }

private:
    const std::filesystem::path& file_;
    std::string_view text_;
    size_t at_ = 0;
};

PtmFormat formatFromName(const std::filesystem::path& file, std::string_view name)
{
    for (const PtmFormat format : {PtmFormat::rgb, PtmFormat::lrgb}) {
        if (name == ptmFormatName(format)) {
            return format;
        }
    }
    throw Error(file, fmt::format("is a {}", name), "PTM_FORMAT_RGB or PTM_FORMAT_LRGB");
}

PtmFile readHeader(const std::filesystem::path& file, Header& header)
{
    PtmFile ptm;
    const std::string_view version = header.word(kPtmVersion);
    if (version != kPtmVersion) {
        throw Error(file, fmt::format("begins with '{}'", version.substr(0, 16)), "a polynomial texture map, PTM_1.2");
    }
    ptm.format = formatFromName(file, header.word("the map's format"));
    ptm.width = header.number<int>("the map's width");
    ptm.height = header.number<int>("the map's height");
    if (ptm.width < 1 || ptm.height < 1 || ptm.width > kLargestSide || ptm.height > kLargestSide) {
        throw Error(file, fmt::format("is {} x {}", ptm.width, ptm.height),
                    fmt::format("sides from 1 to {}", kLargestSide));
    }
    for (float& scale : ptm.scale) {
        scale = header.number<float>("six scales");
        if (!std::isfinite(scale)) {
            throw Error(file, "has a scale that is no number", "six finite scales");
        }
    }
    for (int& bias : ptm.bias) {
        bias = header.number<int>("six whole biases");
    }
    return ptm;
}

std::string headerText(const PtmFile& ptm)
{
    return fmt::format("{}\n{}\n{}\n{}\n{:.9g}\n{}\n", kPtmVersion, ptmFormatName(ptm.format), ptm.width, ptm.height,
                       fmt::join(ptm.scale, " "), fmt::join(ptm.bias, " "));
}

} // namespace

std::string ptmFormatName(PtmFormat format)
{
    return format == PtmFormat::rgb ? "PTM_FORMAT_RGB" : "PTM_FORMAT_LRGB";
}

void savePtm(const std::filesystem::path& file, const PtmFile& ptm)
{
    const std::string header = headerText(ptm);
    std::vector<unsigned char> bytes(header.begin(), header.end());
    const auto append = [&](const std::vector<uint8_t>& block, size_t bytesAPixel) {
        const std::vector<uint8_t> rows = flippedRows(block, bytesAPixel * ptm.width, ptm.height);
        bytes.insert(bytes.end(), rows.begin(), rows.end());
    };
    append(ptm.coefficients, PtmFile::kTerms);
    append(ptm.colours, 3);
    writeWholeFile(file, bytes);
}

PtmFile loadPtm(const std::filesystem::path& file)
{
    const std::string text = readWholeFile(file, "a polynomial texture map");
    Header header(file, text);
    PtmFile ptm = readHeader(file, header);
    const std::string_view data = header.rest();
    const size_t pixels = static_cast<size_t>(ptm.width) * ptm.height;
    const size_t coefficients = PtmFile::kTerms * pixels * (ptm.format == PtmFormat::rgb ? 3 : 1);
    const size_t colours = ptm.format == PtmFormat::rgb ? 0 : 3 * pixels;
    if (data.size() != coefficients + colours) {
        throw Error(file, fmt::format("has {} bytes after its header", data.size()),
                    fmt::format("{} of a {} of {} x {}", coefficients + colours, ptmFormatName(ptm.format), ptm.width,
                                ptm.height));
    }
    const auto middle = data.begin() + static_cast<std::ptrdiff_t>(coefficients);
    ptm.coefficients = flippedRows({data.begin(), middle}, PtmFile::kTerms * ptm.width, ptm.height);
    ptm.colours = flippedRows({middle, data.end()}, size_t{3} * ptm.width, ptm.height);
    return ptm;
}

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
