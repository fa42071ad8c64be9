#pragma once
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

namespace nacre {

// A vector as an array of three numbers.
inline nlohmann::json jsonOf(const glm::vec3& v)
{
    return nlohmann::json::array({v.x, v.y, v.z});
}

// Throws nlohmann's exception where there are no three numbers.
inline glm::vec3 vec3Of(const nlohmann::json& json)
{
    return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

} // namespace nacre
