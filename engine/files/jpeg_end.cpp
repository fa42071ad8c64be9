#include "engine/files/jpeg_end.h"

#include <cstdint>
#include <fstream>

namespace nacre {

namespace {

constexpr int kStartOfImage = 0xd8, kEndOfImage = 0xd9, kTemporary = 0x01;

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

bool isCompleteJpeg(const std::filesystem::path& file)
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
