#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/rti/rti_picture.h"

namespace nacre {

// rgb: a biquadratic for each channel; lrgb: one for all, times the pixel's colour.
enum class PtmFormat { rgb, lrgb };

std::string ptmFormatName(PtmFormat format); // as in the file, e.g. PTM_FORMAT_LRGB

// A polynomial texture map as the file has it (Malzbender and Gelb, Polynomial Texture Map (.ptm) File Format, version
// 1.2, 2001), rows from the top. A coefficient is (byte - bias) scale, in the file's order x^2, y^2, xy, x, y, 1;
// the sum over them is a channel's code, 0 to 255, or with lrgb what the colour's code / 255 is multiplied with.
struct PtmFile {
    static constexpr size_t kTerms = 6;

    PtmFormat format = PtmFormat::lrgb;
    int width = 0;
    int height = 0;
    std::array<float, kTerms> scale{};
    std::array<int, kTerms> bias{};
    std::vector<uint8_t> coefficients; // kTerms a pixel; rgb: all pixels' red, then green, then blue
    std::vector<uint8_t> colours;      // lrgb: R, G, B a pixel; else empty
};

// Quantised to 8 bits over each coefficient's own range. lrgb takes the colour and the biquadratic whose product is
// nearest over the disc of lights.
PtmFile ptmFromRti(const RtiPicture& picture, PtmFormat format);
RtiPicture rtiFromPtm(const PtmFile& ptm);

void savePtm(const std::filesystem::path& file, const PtmFile& ptm);
// PTM_1.2, uncompressed RGB and LRGB. Throws Error (data) on what is cut off, too long or something else.
PtmFile loadPtm(const std::filesystem::path& file);

} // namespace nacre
