#include "engine/files/picture_bytes.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

namespace nacre {
namespace fs = std::filesystem;

namespace {

// gAMA holds 100000 times the exponent from light to code value: 1 is linear, 0.45 the usual display's, which stands
// for sRGB (PNG specification, 1996, 4.2.2.3).
constexpr uint32_t kGamaUnit = 100000, kDisplayGama = 45455, kDisplayGamaWidth = 1000;

uint32_t bigEndian(const unsigned char* bytes)
{
    return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

TransferCurve curveOfGama(uint32_t gama)
{
    if (gama == 0 || (gama > kDisplayGama - kDisplayGamaWidth && gama < kDisplayGama + kDisplayGamaWidth)) {
        return TransferCurve::srgb;
    }
    return powerCurve(static_cast<double>(kGamaUnit) / gama);
}

constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kStartOfScan = 0xda, kApp1 = 0xe1, kTemporary = 0x01;

bool isRestart(int marker)
{
    return marker >= 0xd0 && marker <= 0xd7;
}

// The next marker at or after the position; what stands between 0xff bytes of coded data (0xff 0x00, restarts) and it
// is passed over. -1 at the file's end.
int nextMarker(std::streambuf& bytes)
{
    constexpr int kEnd = std::streambuf::traits_type::eof();
    int byte = bytes.sbumpc();
    while (byte != kEnd) {
        if (byte != 0xff) {
            byte = bytes.sbumpc();
            continue;
        }
        byte = bytes.sbumpc();
        if (byte != kEnd && byte != 0x00 && byte != 0xff && !isRestart(byte) && byte != kTemporary) {
            return byte;
        }
    }
    return -1;
}

} // namespace

std::optional<TransferCurve> pngCurve(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(8); // signature
    std::optional<TransferCurve> curve;
    unsigned char head[8];
    while (stream.read(reinterpret_cast<char*>(head), sizeof head)) {
        const uint32_t length = bigEndian(head);
        const std::string type(reinterpret_cast<char*>(head) + 4, 4);
        if (type == "IDAT" || type == "IEND") {
            break;
        }
        if (type == "sRGB") {
            return TransferCurve::srgb;
        }
        if (type == "gAMA" && length == 4) {
            unsigned char gamma[4];
            stream.read(reinterpret_cast<char*>(gamma), sizeof gamma);
            curve = curveOfGama(bigEndian(gamma));
            stream.seekg(4, std::ios::cur);
        } else {
            stream.seekg(std::streamoff{length} + 4, std::ios::cur);
        }
    }
    return curve;
}

bool statesAdobeRgb(const fs::path& file)
{
    using namespace std::string_literals;
    // The entry: tag 1, four bytes of text; numbers in either order of bytes.
    const std::string big = "\0\1\0\2\0\0\0\4R03\0"s, little = "\1\0\2\0\4\0\0\0R03\0"s;
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(2); // start of image
    std::streambuf& bytes = *stream.rdbuf();
    for (int marker = nextMarker(bytes); marker >= 0 && marker != kStartOfScan; marker = nextMarker(bytes)) {
        const int high = bytes.sbumpc(), low = bytes.sbumpc();
        std::string segment(static_cast<size_t>(std::max((high << 8 | low) - 2, 0)), '\0'); // a length counts itself
        stream.read(segment.data(), static_cast<std::streamsize>(segment.size()));
        if (marker == kApp1 && segment.starts_with("Exif")) {
            return segment.find(big) != std::string::npos || segment.find(little) != std::string::npos;
        }
    }
    return false;
}

bool isCompleteJpeg(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::streambuf& bytes = *stream.rdbuf();
    if (bytes.sbumpc() != 0xff || bytes.sbumpc() != kStartOfImage) {
        return true;
    }
    for (int marker = nextMarker(bytes); marker >= 0; marker = nextMarker(bytes)) {
        if (marker == kEndOfImage) {
            return true;
        }
        const int high = bytes.sbumpc(), low = bytes.sbumpc(); // a segment's length, itself included
        const int length = high << 8 | low;
        if (high < 0 || low < 0 || length < 2) {
            return false;
        }
        stream.seekg(length - 2, std::ios::cur);
    }
    return false;
}

} // namespace nacre
