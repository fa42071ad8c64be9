#include "engine/scene/light_source.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "engine/lights/light_motion.h"

namespace nacre {

namespace {

constexpr std::string_view kOff = "off:";
constexpr std::string_view kSoft = "soft:";
constexpr std::string_view kNear = "near:";
constexpr std::string_view kCaptured = "captured:";

Error lightError(const std::string& text, const std::string& wrong, const std::string& expected)
{
    return Error("", fmt::format("light {} {}", text, wrong), expected, Error::kUsage);
}

// Takes `prefix` off the front of `rest`; false where something else is there.
bool takePrefix(std::string& rest, std::string_view prefix)
{
    if (!rest.starts_with(prefix)) {
        return false;
    }
    rest.erase(0, prefix.size());
    return true;
}

// Takes the number in front of a colon off the front of `rest`; NaN where there is none.
float takeNumber(std::string& rest)
{
    const size_t colon = rest.find(':');
    const std::vector<float> numbers = numbersFromText(rest.substr(0, colon));
    if (colon == std::string::npos || numbers.size() != 1) {
        return std::numeric_limits<float>::quiet_NaN();
    }
    rest.erase(0, colon + 1);
    return numbers.front();
}

float takeSoftness(const std::string& text, std::string& rest)
{
    if (!takePrefix(rest, kSoft)) {
        return 0;
    }
    const float radius = takeNumber(rest);
    if (!(radius > 0) || radius > 90) {
        throw lightError(text, "has no radius", "soft:DEGREES:x,y,z with a radius above 0, at most 90");
    }
    return radius;
}

float takeDistance(const std::string& text, std::string& rest)
{
    if (!takePrefix(rest, kNear)) {
        return LightSource().distance;
    }
    const float widths = takeNumber(rest);
    if (!(widths >= static_cast<float>(kNearestLight))) {
        throw lightError(text, "has no distance outside the object",
                         fmt::format("near:WIDTHS:x,y,z with {} widths of the object or more", kNearestLight));
    }
    return widths;
}

int capturedNumber(const std::string& text, const std::string& digits)
{
    int number = 0;
    const char* end = digits.data() + digits.size();
    const auto [next, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || next != end || number < 1) {
        throw lightError(text, "is not there", "captured:N with N from 1, see nacre info");
    }
    return number;
}

// A light straight behind the object reaches nothing that the camera sees, and has no half vector.
bool isStraightBehind(const glm::vec3& direction)
{
    constexpr float kCosineOfOneDegree = 0.99985f;
    return direction.z < -kCosineOfOneDegree * glm::length(direction);
}

void readNumbers(const std::string& text, const std::string& rest, LightSource& source)
{
    const std::vector<float> n = numbersFromText(rest);
    if (n.size() != 3 && n.size() != 6) {
        throw lightError(text, "is not understood",
                         "x,y,z or x,y,z,r,g,b or captured:N, near:WIDTHS: or soft:DEGREES: before it where wanted");
    }
    source.direction = {n[0], n[1], n[2]};
    if (source.direction == glm::vec3(0)) {
        throw lightError(text, "has no direction", "x,y,z towards the light, not all 0");
    }
    if (isStraightBehind(source.direction)) {
        throw lightError(text, "is straight behind the surface",
                         "a light that the visible side can see (z is towards the camera)");
    }
    if (n.size() == 6) {
        source.irradiance = {n[3], n[4], n[5]};
        if (std::min({n[3], n[4], n[5]}) < 0) {
            throw lightError(text, "has a negative irradiance", "r,g,b of 0 or more");
        }
    }
}

std::string commaText(const glm::vec3& v)
{
    return fmt::format("{},{},{}", v.x, v.y, v.z);
}

} // namespace

std::vector<float> numbersFromText(const std::string& text)
{
    std::vector<float> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (true) {
        float number = 0;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number) || (next != end && *next != ',')) {
            return {};
        }
        numbers.push_back(number);
        if (next == end) {
            return numbers;
        }
        at = next + 1;
    }
}

LightSource lightSourceFromText(const std::string& text)
{
    LightSource source;
    std::string rest = text;
    source.on = !takePrefix(rest, kOff);
    source.softDegrees = takeSoftness(text, rest);
    if (takePrefix(rest, kCaptured)) {
        source.captured = capturedNumber(text, rest);
    } else {
        source.distance = takeDistance(text, rest);
        readNumbers(text, rest, source);
    }
    return source;
}

std::string textOf(const LightSource& source)
{
    std::string text(source.on ? "" : kOff);
    if (source.softDegrees > 0) {
        text += fmt::format("{}{}:", kSoft, source.softDegrees);
    }
    if (source.captured > 0) {
        return text + fmt::format("{}{}", kCaptured, source.captured);
    }
    if (std::isfinite(source.distance)) {
        text += fmt::format("{}{}:", kNear, source.distance);
    }
    text += commaText(source.direction);
    return source.irradiance == glm::vec3(1) ? text : text + "," + commaText(source.irradiance);
}

Light lightOf(const LightSource& source, std::span<const CapturedLight> captured)
{
    if (source.captured == 0) {
        const glm::dvec3 direction(source.direction);
        return {glm::vec3(direction / glm::length(direction)), source.irradiance, source.distance};
    }
    const auto number = static_cast<size_t>(source.captured);
    if (number > captured.size()) {
        throw lightError(textOf(source), "is not there",
                         captured.empty() ? "this surface holds no captured light, give x,y,z"
                                          : fmt::format("captured:1 to captured:{}", captured.size()));
    }
    return captured[number - 1].light;
}

std::vector<Light> lightsOf(std::span<const LightSource> sources, std::span<const CapturedLight> captured)
{
    std::vector<Light> lights;
    for (const LightSource& source : sources) {
        const Light light = lightOf(source, captured);
        if (source.on && source.softDegrees > 0) {
            const std::vector<Light> bundle = softLight(light, glm::radians(source.softDegrees), kSoftLights);
            lights.insert(lights.end(), bundle.begin(), bundle.end());
        } else if (source.on) {
            lights.push_back(light);
        }
    }
    return lights;
}

LightSource defaultLightSource(std::span<const CapturedLight> captured)
{
    return captured.empty() ? LightSource{.direction = {0.3f, 0.4f, 0.87f}} : LightSource{.captured = 1};
}

} // namespace nacre
