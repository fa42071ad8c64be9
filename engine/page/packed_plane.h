#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nacre {

// Pictures of whole numbers for a page: what remains of each pixel after prediction from its neighbours (the
// median edge detector of Weinberger, Seroussi, Sapiro, The LOCO-I Lossless Image Compression Algorithm, 2000), row by
// row. Pixels outside of the mask (0) cost nothing and come back as anything. page_data.js has the inverse.

// One byte a pixel, modulo 256.
std::vector<unsigned char> filteredPlane(std::span<const uint8_t> values, int width, std::span<const uint8_t> mask);

// Two bytes a pixel: differences modulo 65536, of small size and any sign as small numbers (0, -1, 1, -2, ...), all
// high bytes before all low ones.
std::vector<unsigned char> filteredPlane(std::span<const uint16_t> values, int width, std::span<const uint8_t> mask);

// DEFLATE in zlib's wrapping (RFC 1950), as a browser's DecompressionStream("deflate") reads it, in base64.
std::string deflatedText(std::span<const unsigned char> bytes);

} // namespace nacre
