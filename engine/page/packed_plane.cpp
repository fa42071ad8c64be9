#include "engine/page/packed_plane.h"

#include <algorithm>
#include <new>

#include <zlib.h>

#include "engine/files/markup.h"

namespace nacre {
namespace {

// By the neighbours to the left, above, and above to the left, which are 0 outside of the picture.
int predicted(int left, int above, int corner)
{
    if (corner >= std::max(left, above)) {
        return std::min(left, above);
    }
    return corner <= std::min(left, above) ? std::max(left, above) : left + above - corner;
}

// Calls visit(pixel, difference) in reading order; pixels outside of the mask take their prediction.
template <class Number, class Visit>
void forEachDifference(std::span<const Number> values, int width, std::span<const uint8_t> mask, Visit&& visit)
{
    std::vector<Number> known(values.size());
    const auto w = static_cast<size_t>(width);
    for (size_t i = 0; i < values.size(); ++i) {
        const size_t column = i % w;
        const int left = column > 0 ? known[i - 1] : 0;
        const int above = i >= w ? known[i - w] : 0;
        const int corner = column > 0 && i >= w ? known[i - w - 1] : 0;
        const auto guess = static_cast<Number>(predicted(left, above, corner));
        known[i] = mask[i] != 0 ? values[i] : guess;
        visit(i, static_cast<Number>(known[i] - guess));
    }
}

} // namespace

std::vector<unsigned char> filteredPlane(std::span<const uint8_t> values, int width, std::span<const uint8_t> mask)
{
    std::vector<unsigned char> bytes(values.size());
    forEachDifference(values, width, mask, [&](size_t i, uint8_t difference) { bytes[i] = difference; });
    return bytes;
}

std::vector<unsigned char> filteredPlane(std::span<const uint16_t> values, int width, std::span<const uint8_t> mask)
{
    std::vector<unsigned char> bytes(2 * values.size());
    forEachDifference(values, width, mask, [&](size_t i, uint16_t difference) {
        const auto small = static_cast<uint16_t>((difference << 1) ^ (difference >= 0x8000 ? 0xFFFF : 0));
        bytes[i] = static_cast<unsigned char>(small >> 8);
        bytes[values.size() + i] = static_cast<unsigned char>(small & 0xFF);
    });
    return bytes;
}

std::string deflatedText(std::span<const unsigned char> bytes)
{
    constexpr int kLargestWindow = 15, kMostMemory = 9;
    z_stream stream{};
    // Differences are noise of few values and runs of zeros: no repetitions are looked for.
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kLargestWindow, kMostMemory, Z_RLE) != Z_OK) {
        throw std::bad_alloc(); // nothing else can be wrong with these
    }
    std::string text(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = const_cast<unsigned char*>(bytes.data()); // zlib's own declaration; it does not write there
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<unsigned char*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    deflate(&stream, Z_FINISH);
    text.resize(stream.total_out);
    deflateEnd(&stream);
    return base64(text);
}

} // namespace nacre
