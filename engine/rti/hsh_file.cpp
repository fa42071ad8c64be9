#include "engine/rti/hsh_file.h"

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

constexpr int kHarmonics = 3, kHshChannels = 3, kSeparate = 2, kBytesEach = 1; // of the header
constexpr int kLargestHshSide = 1 << 16;

struct HshHeader {
    int type = 0, width = 0, height = 0, channels = 0, terms = 0, basisType = 0, bytesEach = 0;
};

// The next line that is no comment; what is left of the text begins behind it.
std::string lineOfHeader(const std::filesystem::path& file, std::string_view& text)
{
    while (true) {
        const size_t end = text.find('\n');
        if (end == text.npos) {
            throw Error(file, "ends in its header", "an .rti of hemispherical harmonics (#HSH1.2)");
        }
        std::string line(text.substr(0, end));
        text.remove_prefix(end + 1);
        if (!line.empty() && line[0] != '#') {
            return line;
        }
    }
}

HshHeader readHshHeader(const std::filesystem::path& file, std::string_view& text)
{
    HshHeader header;
    std::istringstream first(lineOfHeader(file, text));
    first >> header.type;
    if (!first || header.type != kHarmonics) {
        throw Error(file, "is another kind of .rti", "hemispherical harmonics, whose first line is 3");
    }
    std::istringstream second(lineOfHeader(file, text)), third(lineOfHeader(file, text));
    second >> header.width >> header.height >> header.channels;
    third >> header.terms >> header.basisType >> header.bytesEach;
    const bool hasSize = header.width > 0 && header.height > 0 && header.width <= kLargestHshSide &&
                         header.height <= kLargestHshSide && header.channels == kHshChannels;
    if (!second || !hasSize) {
        throw Error(file, "has no such size", "width, height and 3 channels in its second line");
    }
    const bool isRead = header.terms == 1 || header.terms == 4 || header.terms == 9;
    if (!third || !isRead || header.basisType != kSeparate || header.bytesEach != kBytesEach) {
        throw Error(
            file,
            fmt::format("has {} terms of type {}, {} bytes each", header.terms, header.basisType, header.bytesEach),
            "1, 4 or 9 terms of type 2, a byte each");
    }
    return header;
}

std::vector<float> readFloats(const std::filesystem::path& file, std::string_view& bytes, int count)
{
    std::vector<float> values(count);
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float)); // little endian, as this machine
    bytes.remove_prefix(values.size() * sizeof(float));
    for (const float value : values) {
        if (!std::isfinite(value)) {
            throw Error(file, "has a scale or bias that is no number", "finite ones");
        }
    }
    return values;
}

} // namespace

RtiPicture loadHsh(const std::filesystem::path& file)
{
    const std::string content = readWholeFile(file, "an .rti file");
    std::string_view bytes = content;
    const HshHeader header = readHshHeader(file, bytes);
    const size_t terms = header.terms, pixels = static_cast<size_t>(header.width) * header.height;
    const size_t expected = 2 * terms * sizeof(float) + pixels * kHshChannels * terms;
    if (bytes.size() != expected) {
        throw Error(file, fmt::format("has {} bytes behind its header", bytes.size()), fmt::format("{}", expected));
    }
    const std::vector<float> scales = readFloats(file, bytes, header.terms),
                             biases = readFloats(file, bytes, header.terms);
    RtiPicture picture{RtiBasis::hsh, {}};
    picture.terms.assign(rtiTermCount(RtiBasis::hsh), Image(header.width, header.height, kHshChannels));
    size_t next = 0;
    for (size_t p = 0; p < pixels; ++p) {
        for (size_t c = 0; c < kHshChannels; ++c) {
            for (size_t k = 0; k < terms; ++k) {
                const auto code = static_cast<unsigned char>(bytes[next++]);
                picture.terms[k].values[kHshChannels * p + c] = static_cast<float>(code) / 255 * scales[k] + biases[k];
            }
        }
    }
    return picture;
}

} // namespace nacre
