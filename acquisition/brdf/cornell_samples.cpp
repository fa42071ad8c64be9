#include "acquisition/brdf/cornell_samples.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/materials/cie_colour.h"

namespace nacre {
namespace {

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

// Steele, Lea and Flood, Fast Splittable Pseudorandom Number Generators, 2014: the finaliser of SplitMix64.
bool isKeptOfFive(size_t index)
{
    uint64_t z = index + 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (z ^ (z >> 31)) % 5 != 0;
}

} // namespace nacre
