#include "engine/scene/turn.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "engine/files/error.h"
#include "engine/scene/light_source.h"

namespace nacre {

Turn turnFromText(const std::string& text)
{
    const std::vector<float> numbers = numbersFromText(text);
    const bool isTurn = numbers.size() == 2 || numbers.size() == 3;
    const auto isAngle = [](float number) { return std::abs(number) <= 360; };
    if (!isTurn || !std::all_of(numbers.begin(), numbers.end(), isAngle)) {
        throw Error("", fmt::format("turn {} is not understood", text), "YAW,PITCH[,ROLL] in degrees, -360 to 360",
                    Error::kUsage);
    }
    return {numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0};
}

std::string textOf(const Turn& turn)
{
    return turn.roll == 0 ? fmt::format("{},{}", turn.yaw, turn.pitch)
                          : fmt::format("{},{},{}", turn.yaw, turn.pitch, turn.roll);
}

glm::dmat3 matrixOf(const Turn& turn)
{
    const glm::dvec3 angle = glm::radians(glm::dvec3(turn.pitch, turn.yaw, turn.roll));
    const glm::dvec3 c = glm::cos(angle), s = glm::sin(angle);
    const glm::dmat3 yaw(c.y, 0, -s.y, 0, 1, 0, s.y, 0, c.y); // columns
    const glm::dmat3 pitch(1, 0, 0, 0, c.x, s.x, 0, -s.x, c.x);
    const glm::dmat3 roll(c.z, s.z, 0, -s.z, c.z, 0, 0, 0, 1);
    return roll * pitch * yaw;
}

} // namespace nacre
