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
    uLongf length = compressBound(bytes.size());
    std::vector<unsigned char> deflated(length);
    if (compress2(deflated.data(), &length, bytes.data(), bytes.size(), Z_BEST_COMPRESSION) != Z_OK) {
        throw std::bad_alloc(); // the only thing that can go wrong with a buffer of this length
    }
    return base64(std::string_view(reinterpret_cast<const char*>(deflated.data()), length));
}

} // namespace nacre
