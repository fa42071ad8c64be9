#include "app/light_argument.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/scene/error.h"
#include "engine/scene/light_motion.h"

namespace nacre {

namespace {

constexpr const char* kCaptured = "captured:";
constexpr const char* kSoft = "soft:";

Error lightError(const std::string& text, const std::string& wrong, const std::string& expected)
{
    return Error("", fmt::format("--light {} {}", text, wrong), expected, Error::kUsage);
}

// Numbers between commas; none where anything else is there.
std::optional<std::vector<float>> numbersOf(const std::string& text)
{
    std::vector<float> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (true) {
        float number = 0;
        const auto [next, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) {
            return std::nullopt;
        }
        numbers.push_back(number);
        if (next == end) {
            return numbers;
        }
        if (*next != ',') {
            return std::nullopt;
        }
        at = next + 1;
    }
}

// What follows "soft:DEGREES:", and the radius in radians; 0 for a light without it.
std::pair<std::string, float> withoutSoftness(const std::string& text)
{
    if (text.rfind(kSoft, 0) != 0) {
        return {text, 0.0f};
    }
    const size_t first = std::string(kSoft).size(), colon = text.find(':', first);
    const auto radius = colon == std::string::npos ? std::nullopt : numbersOf(text.substr(first, colon - first));
    if (!radius || radius->size() != 1 || !(radius->front() > 0) || radius->front() > 90) {
        throw lightError(text, "has no radius", "soft:DEGREES:x,y,z with a radius above 0, at most 90");
    }
    return {text.substr(colon + 1), glm::radians(radius->front())};
}

Light capturedLight(const std::string& text, const std::vector<CapturedLight>& captured)
{
    size_t number = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data() + std::string(kCaptured).size(), end, number);
    if (error != std::errc() || next != end || number < 1 || number > captured.size()) {
        throw lightError(text, "is not there",
                         captured.empty() ? "this surface holds no captured light, give x,y,z"
                                          : fmt::format("captured:1 to captured:{}", captured.size()));
    }
    return captured[number - 1].light;
}

// A light straight behind the object reaches nothing that the camera sees, and has no half vector.
bool isStraightBehind(const glm::vec3& direction)
{
    constexpr float kCosineOfOneDegree = 0.99985f;
    return direction.z < -kCosineOfOneDegree;
}

} // namespace

std::vector<float> numbersFromArgument(const std::string& text)
{
    return numbersOf(text).value_or(std::vector<float>{});
}

Light lightFromArgument(const std::string& text, const std::vector<CapturedLight>& captured)
{
    if (text.rfind(kCaptured, 0) == 0) {
        return capturedLight(text, captured);
    }
    const auto numbers = numbersOf(text);
    if (!numbers || (numbers->size() != 3 && numbers->size() != 6)) {
        throw lightError(text, "is not understood", "x,y,z or x,y,z,r,g,b or captured:N");
    }
    const std::vector<float>& n = *numbers;
    const glm::dvec3 direction(n[0], n[1], n[2]);
    const double size = glm::length(direction);
    if (size == 0) {
        throw lightError(text, "has no direction", "x,y,z towards the light, not all 0");
    }
    Light light{.direction = glm::vec3(direction / size), .irradiance = glm::vec3(1)};
    if (isStraightBehind(light.direction)) {
        throw lightError(text, "is straight behind the surface",
                         "a light that the visible side can see (z is towards the camera)");
    }
    if (n.size() == 6) {
        light.irradiance = {n[3], n[4], n[5]};
        if (std::min({n[3], n[4], n[5]}) < 0) {
            throw lightError(text, "has a negative irradiance", "r,g,b of 0 or more");
        }
    }
    return light;
}

std::vector<Light> lightsFromArguments(const std::vector<std::string>& texts,
                                       const std::vector<CapturedLight>& captured)
{
    if (texts.empty()) {
        return {lightFromArgument(captured.empty() ? "0.3,0.4,0.87" : "captured:1", captured)};
    }
    std::vector<Light> lights;
    for (const std::string& text : texts) {
        const auto [plain, radius] = withoutSoftness(text);
        const Light light = lightFromArgument(plain, captured);
        const std::vector<Light> bundle =
            radius > 0 ? softLight(light, radius, kSoftLights) : std::vector<Light>{light};
        lights.insert(lights.end(), bundle.begin(), bundle.end());
    }
    return lights;
}

} // namespace nacre
