#include "acquisition/capture/progressive_pictures.h"

#include <cstdint>
#include <fstream>
#include <string_view>

namespace nacre {

namespace {

constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";
constexpr std::streamoff kPngInterlaceByte = 28; // behind the signature: IHDR's length and name, 12 bytes of its data

// ITU-T T.81 (JPEG), 1992, table B.1: markers that follow each other with a length each, up to the start of the frame.
bool isProgressiveFrame(std::ifstream& stream)
{
    stream.seekg(2); // start of image
    uint8_t head[4]; // 0xff, marker, length
    while (stream.read(reinterpret_cast<char*>(head), sizeof head) && head[0] == 0xff) {
        const int marker = head[1];
        if (marker == 0xff) { // a fill byte
            stream.seekg(-3, std::ios::cur);
            continue;
        }
        const bool tables = marker == 0xc4 || marker == 0xc8 || marker == 0xcc;
        if (marker >= 0xc0 && marker <= 0xcf && !tables) {
            return (marker & 3) == 2; // SOF2, 6, 10, 14
        }
        stream.seekg((head[2] << 8 | head[3]) - 2, std::ios::cur);
    }
    return false;
}

} // namespace

bool isProgressive(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    char start[kPngSignature.size()] = {};
    stream.read(start, sizeof start);
    const std::string_view signature(start, sizeof start);
    if (signature == kPngSignature) {
        stream.seekg(kPngInterlaceByte);
        return stream.get() == 1;
    }
    return signature.starts_with("\xff\xd8") && isProgressiveFrame(stream);
}

} // namespace nacre
