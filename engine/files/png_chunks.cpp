#include "engine/files/png_chunks.h"

#include <cstdint>
#include <fstream>
#include <string>

namespace nacre {

namespace {

// gAMA holds 100000 times the exponent from light to code value: 1 is linear, 0.45 the usual display. What lies
// between is taken for the nearer of both.
constexpr uint32_t kLinearGamaAbove = 72700;

uint32_t bigEndian(const unsigned char* bytes)
{
    return uint32_t{bytes[0]} << 24 | uint32_t{bytes[1]} << 16 | uint32_t{bytes[2]} << 8 | bytes[3];
}

} // namespace

PngColour readPngColour(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(8); // signature
    PngColour colour;
    unsigned char head[8];
    while (stream.read(reinterpret_cast<char*>(head), sizeof head)) {
        const uint32_t length = bigEndian(head);
        const std::string type(reinterpret_cast<char*>(head) + 4, 4);
        if (type == "IDAT" || type == "IEND") {
            break;
        }
        if (type == "sRGB" || type == "iCCP") {
            return {true, TransferCurve::srgb};
        }
        if (type == "gAMA" && length == 4) {
            unsigned char gamma[4];
            stream.read(reinterpret_cast<char*>(gamma), sizeof gamma);
            colour = {true, bigEndian(gamma) > kLinearGamaAbove ? TransferCurve::linear : TransferCurve::srgb};
            stream.seekg(4, std::ios::cur);
        } else {
            stream.seekg(std::streamoff{length} + 4, std::ios::cur);
        }
    }
    return colour;
}

} // namespace nacre
