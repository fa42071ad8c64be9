#include "engine/materials/cie_colour.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/mat3x3.hpp>

namespace nacre {
namespace {

constexpr int kFirst = 400, kStep = 10, kCount = 31; // nm

// CIE 015:2018, Colorimetry: colour-matching functions of the 1931 standard observer, and D65.
struct Row {
    double x, y, z, d65;
};
constexpr Row kRows[kCount] = {
    {0.01431, 0.000396, 0.06785, 82.7549}, {0.04351, 0.00121, 0.2074, 91.486},   {0.13438, 0.0040, 0.6456, 93.4318},
    {0.2839, 0.0116, 1.3856, 86.6823},     {0.34828, 0.0230, 1.74706, 104.865},  {0.3362, 0.0380, 1.77211, 117.008},
    {0.2908, 0.0600, 1.6692, 117.812},     {0.19536, 0.09098, 1.28764, 114.861}, {0.09564, 0.13902, 0.81295, 115.923},
    {0.03201, 0.20802, 0.46518, 108.811},  {0.0049, 0.3230, 0.2720, 109.354},    {0.0093, 0.5030, 0.1582, 107.802},
    {0.06327, 0.7100, 0.07825, 104.790},   {0.1655, 0.8620, 0.04216, 107.689},   {0.2904, 0.9540, 0.0203, 104.405},
    {0.43345, 0.99495, 0.00875, 104.046},  {0.5945, 0.9950, 0.0039, 100.0},      {0.7621, 0.9520, 0.0021, 96.3342},
    {0.9163, 0.8700, 0.00165, 95.788},     {1.0263, 0.7570, 0.0011, 88.6856},    {1.0622, 0.6310, 0.0008, 90.0062},
    {1.0026, 0.5030, 0.00034, 89.5991},    {0.85445, 0.3810, 0.00019, 87.6987},  {0.6424, 0.2650, 0.00005, 83.2886},
    {0.4479, 0.1750, 0.00002, 83.6992},    {0.2835, 0.1070, 0.0, 80.0268},       {0.1649, 0.0610, 0.0, 80.2146},
    {0.0874, 0.0320, 0.0, 82.2778},        {0.04677, 0.0170, 0.0, 78.2842},      {0.0227, 0.00821, 0.0, 69.7213},
    {0.01136, 0.0041, 0.0, 71.6091},
};

// ITU-R BT.709-6: from CIE XYZ with Y = 1 for white; columns.
const glm::dmat3 kRec709FromXyz(3.2409699, -0.9692436, 0.0556301, -1.5373832, 1.8759675, -0.2039770, -0.4986108,
                                0.0415551, 1.0569715);

double spectrumAt(std::span<const float> wavelengths, std::span<const float> spectrum, double wavelength)
{
    const auto above = std::lower_bound(wavelengths.begin(), wavelengths.end(), wavelength);
    const size_t i = above - wavelengths.begin();
    if (i == 0 || *above == wavelength) {
        return spectrum[i];
    }
    const double share = (wavelength - wavelengths[i - 1]) / (wavelengths[i] - wavelengths[i - 1]);
    return std::lerp<double>(spectrum[i - 1], spectrum[i], share);
}

template <class Reflectance> glm::dvec3 integrate(Reflectance&& reflectance)
{
    glm::dvec3 xyz(0);
    double white = 0;
    for (int i = 0; i < kCount; ++i) {
        const Row& row = kRows[i];
        xyz += glm::dvec3(row.x, row.y, row.z) * (row.d65 * reflectance(kFirst + i * kStep));
        white += row.y * row.d65;
    }
    return kRec709FromXyz * (xyz / white);
}

} // namespace

glm::vec3 rec709FromReflectance(std::span<const float> wavelengths, std::span<const float> spectrum)
{
    assert(wavelengths.size() == spectrum.size() && !wavelengths.empty());
    assert(wavelengths.front() <= kFirst && wavelengths.back() >= kFirst + (kCount - 1) * kStep);
    // What 400 to 700 nm cut off of the white shifts it by a thousandth; dividing makes white exact.
    static const glm::dvec3 white = integrate([](double) { return 1.0; });
    return glm::vec3(integrate([&](double nm) { return spectrumAt(wavelengths, spectrum, nm); }) / white);
}

} // namespace nacre
