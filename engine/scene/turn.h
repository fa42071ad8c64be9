#pragma once
#include <string>

#include <glm/mat3x3.hpp>

namespace nacre {

// How an object stands before a distant camera, in degrees, one after the other: yaw about the picture's up axis (its
// front goes right), pitch about the axis across (its top comes nearer), roll about the viewing axis
// (counter-clockwise).
struct Turn {
    float yaw = 0;
    float pitch = 0;
    float roll = 0;
    bool operator==(const Turn&) const = default;
};

// "YAW,PITCH[,ROLL]". Throws Error (usage).
Turn turnFromText(const std::string& text);
std::string textOf(const Turn& turn);

// From the axes of the object that is not turned to the camera's (x right, y up, z towards the viewer).
glm::dmat3 matrixOf(const Turn& turn);

} // namespace nacre
