#include "engine/files/icc_profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

namespace nacre {

namespace {

using Bytes = std::span<const unsigned char>;

constexpr size_t kHeader = 128, kTagEntry = 12, kElementHead = 8;
// x, y, z of Rec. 709's red, green and blue, adapted to the profiles' D50 as sRGB profiles have them.
constexpr std::array<std::array<double, 3>, 3> kPrimaries = {
    {{0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7141}}};
constexpr double kSamePrimary = 0.02;

// Numbers past the end are 0.
uint32_t whole(Bytes bytes, size_t at, size_t count)
{
    uint32_t value = 0;
    for (size_t i = at; i < at + count; ++i) {
        value = value << 8 | (i < bytes.size() ? bytes[i] : 0u);
    }
    return value;
}

double fixed(Bytes bytes, size_t at) // s15Fixed16
{
    return static_cast<double>(static_cast<int32_t>(whole(bytes, at, 4))) / 65536;
}

bool isNamed(Bytes bytes, size_t at, std::string_view name)
{
    return at + 4 <= bytes.size() && std::equal(name.begin(), name.end(), bytes.begin() + static_cast<long>(at));
}

// Empty where there is none, or where it is not in the profile.
Bytes elementOf(Bytes profile, std::string_view tag)
{
    const size_t count = whole(profile, kHeader, 4);
    for (size_t i = 0, at = kHeader + 4; i < count && at + kTagEntry <= profile.size(); ++i, at += kTagEntry) {
        const size_t offset = whole(profile, at + 4, 4), size = whole(profile, at + 8, 4);
        if (isNamed(profile, at, tag) && offset <= profile.size() && size <= profile.size() - offset) {
            return profile.subspan(offset, size);
        }
    }
    return {};
}

// "curv": an exponent, or a table of 16-bit numbers.
std::vector<float> countedCurve(Bytes element)
{
    const size_t count = whole(element, kElementHead, 4);
    if (count == 0) {
        return {0, 1};
    }
    if (count == 1) {
        const double exponent = whole(element, kElementHead + 4, 2) / 256.0;
        return sampledCurve([=](double x) { return std::pow(x, exponent); });
    }
    if (count > (element.size() - kElementHead - 4) / 2) {
        return {};
    }
    std::vector<float> table;
    for (size_t i = 0; i < count; ++i) {
        table.push_back(static_cast<float>(whole(element, kElementHead + 4 + 2 * i, 2)) / 65535);
    }
    return table;
}

// "para": (a x + b)^g + e from d on, c x + f below, of which lower types have fewer parameters.
std::vector<float> formulaCurve(Bytes element)
{
    constexpr std::array<size_t, 5> kParameters = {1, 3, 4, 5, 7};
    const size_t type = whole(element, kElementHead, 2);
    if (type >= kParameters.size() || element.size() < kElementHead + 4 + 4 * kParameters[type]) {
        return {};
    }
    double g = 1, a = 1, b = 0, c = 0, d = 0, e = 0, f = 0;
    double* const order[] = {&g, &a, &b, &c, &d, &e, &f};
    for (size_t i = 0; i < kParameters[type]; ++i) {
        *order[i] = fixed(element, kElementHead + 4 + 4 * i);
    }
    if (type == 1 || type == 2) { // a step's place in terms of the others, and what type 2 calls c
        d = -b / a;
        e = f = type == 2 ? c : 0;
        c = 0;
    }
    return sampledCurve([=](double x) { return x >= d ? std::pow(std::max(a * x + b, 0.0), g) + e : c * x + f; });
}

std::vector<float> tableOf(Bytes element)
{
    std::vector<float> table = isNamed(element, 0, "curv")   ? countedCurve(element)
                               : isNamed(element, 0, "para") ? formulaCurve(element)
                                                             : std::vector<float>();
    const bool rises = table.size() > 1 && std::is_sorted(table.begin(), table.end()) && table.back() > table.front();
    return rises && std::isfinite(table.back()) ? table : std::vector<float>();
}

bool hasOtherPrimaries(Bytes profile)
{
    constexpr std::array<std::string_view, 3> kTags = {"rXYZ", "gXYZ", "bXYZ"};
    for (size_t i = 0; i < kTags.size(); ++i) {
        const Bytes element = elementOf(profile, kTags[i]);
        for (size_t k = 0; !element.empty() && k < 3; ++k) {
            if (std::abs(fixed(element, kElementHead + 4 * k) - kPrimaries[i][k]) > kSamePrimary) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

std::optional<IccColour> readIccProfile(Bytes profile)
{
    Bytes element = elementOf(profile, "gTRC");
    if (element.empty()) {
        element = elementOf(profile, "kTRC");
    }
    const std::vector<float> table = tableOf(element);
    if (table.empty()) {
        return {};
    }
    const double middle = table[table.size() / 2],
                 half = static_cast<double>(table.size() / 2) / static_cast<double>(table.size() - 1);
    const std::string name = fmt::format("ICC profile's, about power {:.2g}", std::log(middle) / std::log(half));
    return IccColour{tabulatedCurve(name, table), hasOtherPrimaries(profile)};
}

} // namespace nacre
