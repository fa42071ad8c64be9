#include "engine/rti/ptm_file.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

constexpr const char* kVersion = "PTM_1.2";
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
    const std::string_view version = header.word(kVersion);
    if (version != kVersion) {
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
    return fmt::format("{}\n{}\n{}\n{}\n{:.9g}\n{}\n", kVersion, ptmFormatName(ptm.format), ptm.width, ptm.height,
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

} // namespace nacre
