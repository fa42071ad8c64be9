#include "acquisition/brdf/cornell_samples.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include "engine/files/error.h"
#include "engine/files/hash_random.h"
#include "engine/files/whole_file.h"

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

constexpr const char* kExpected = "a list of Cornell's measured BRDFs";
constexpr size_t kAngles = 4;
constexpr float kMostWavelengths = 2000;

// The numbers of a line; a word that is none is an error of the file.
std::vector<float> numbersOf(const std::filesystem::path& file, size_t line, const std::string& text)
{
    std::vector<float> numbers;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        float number = 0;
        const char* end = word.data() + word.size();
        const auto [stop, problem] = std::from_chars(word.data(), end, number);
        if (problem != std::errc() || stop != end || !std::isfinite(number)) {
            throw Error(file, fmt::format("line {}: \"{}\" is no number", line, word.substr(0, 40)), kExpected);
        }
        numbers.push_back(number);
    }
    return numbers;
}

// The comments above the number of wavelengths, but for the one that says that it follows.
void addToName(const std::string& comment, std::string& name)
{
    const size_t first = comment.find_first_not_of("# \r");
    if (first != std::string::npos && comment.find("num wls") == std::string::npos) {
        const std::string words = comment.substr(first);
        name += (name.empty() ? "" : "; ") + words.substr(0, words.find('\r'));
    }
}

void checkWavelengths(const std::filesystem::path& file, size_t count, const std::vector<float>& wavelengths)
{
    if (wavelengths.size() != count) {
        throw Error(file, fmt::format("lists {} wavelengths", wavelengths.size()), fmt::format("{}", count));
    }
    if (std::adjacent_find(wavelengths.begin(), wavelengths.end(), std::greater_equal<>()) != wavelengths.end() ||
        wavelengths.front() > 400 || wavelengths.back() < 700) {
        throw Error(file, fmt::format("has wavelengths from {} to {} nm", wavelengths.front(), wavelengths.back()),
                    "ascending ones from 400 to 700 nm");
    }
}

vec3 directionOf(float theta, float phi)
{
    return {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
}

void addMeasurement(const std::filesystem::path& file, size_t line, const std::vector<float>& numbers,
                    CornellMeasurements& result)
{
    if (numbers.size() != kAngles + result.wavelengths.size()) {
        throw Error(file, fmt::format("line {} has {} numbers", line, numbers.size()),
                    fmt::format("{}: four angles and {} wavelengths", kAngles + result.wavelengths.size(),
                                result.wavelengths.size()));
    }
    for (const float theta : {numbers[0], numbers[2]}) {
        if (theta < 0 || theta >= kHalfPi) {
            throw Error(file, fmt::format("line {} has the polar angle {}", line, theta), "radians from 0 to pi/2");
        }
    }
    const std::span<const float> spectrum(numbers.begin() + kAngles, numbers.end());
    const vec3 f = rec709FromReflectance(result.wavelengths, spectrum);
    result.clipped += min(f.x, min(f.y, f.z)) < 0;
    result.values.push_back(max(f, 0.0f));
    result.directions.push_back({directionOf(numbers[0], numbers[1]), directionOf(numbers[2], numbers[3])});
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

CornellMeasurements loadCornellMeasurements(const std::filesystem::path& file)
{
    CornellMeasurements result;
    std::istringstream lines(readWholeFile(file, kExpected));
    size_t line = 0, wavelengthCount = 0;
    for (std::string text; std::getline(lines, text);) {
        ++line;
        const size_t comment = text.find('#');
        if (comment == 0 && wavelengthCount == 0 && line > 1) {
            addToName(text, result.name);
        }
        const std::vector<float> numbers = numbersOf(file, line, text.substr(0, comment));
        if (numbers.empty()) {
            continue;
        }
        if (wavelengthCount == 0) {
            if (numbers.size() != 1 || !(numbers[0] >= 2 && numbers[0] <= kMostWavelengths)) {
                throw Error(file, fmt::format("line {} is no number of wavelengths", line), kExpected);
            }
            wavelengthCount = static_cast<size_t>(numbers[0]);
        } else if (result.wavelengths.size() < wavelengthCount) {
            result.wavelengths.insert(result.wavelengths.end(), numbers.begin(), numbers.end());
            if (result.wavelengths.size() >= wavelengthCount) {
                checkWavelengths(file, wavelengthCount, result.wavelengths);
            }
        } else {
            addMeasurement(file, line, numbers, result);
        }
    }
    if (result.values.empty()) {
        throw Error(file, "holds no measurement", kExpected);
    }
    return result;
}

bool isKeptOfFive(size_t index)
{
    return hashOf(index) % 5 != 0;
}

} // namespace nacre
