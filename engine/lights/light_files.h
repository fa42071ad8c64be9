#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/lights/light.h"

namespace nacre {

class JsonNode;

// Lights as a file gives them, directions normalised.
struct LightFile {
    std::vector<Light> lights;
    std::vector<glm::vec3> vectors;       // as the file has them: places, where their unit is known
    std::vector<std::string> photographs; // one name per light, folders in front possible; empty where none is named
    bool irradianceGiven = false;         // false: irradiance 1
};

// By extension: `.lp`, `.json` ("nacre lights", docs/formats.md), `.yml` (a matrix of OpenCV), `.npy` (NumPy), anything
// else a table of directions, whose lines may begin with their photographs' names.
LightFile loadLightFile(const std::filesystem::path& file);

// RTI: the count of lights, which may be missing, then "file x y z" a line; names may hold spaces.
LightFile loadLpFile(const std::filesystem::path& file);

// The same, or the names of photographs alone, one a line: without lights.
LightFile loadLpList(const std::filesystem::path& file);

// Three numbers a line, or three lines of equal length; three by three is three numbers a line. The count of lights
// may stand before them. Directions are normalised, zero is refused. Irradiances are 1.
LightFile loadDirectionTable(const std::filesystem::path& file);

// The same for irradiances, all positive; a single number a line, or a single line, holds one for all three channels.
std::vector<glm::vec3> loadIrradiances(const std::filesystem::path& file);

// Three numbers in JSON, checked alike.
glm::vec3 directionOf(const JsonNode& node);
glm::vec3 irradianceOf(const JsonNode& node);
// Of a light from the object's middle, in widths of the object. Throws Error (data) where it is inside.
float lightDistanceOf(const JsonNode& node);

// The "nacre lights" JSON; without irradiances where they are not given.
void saveLightFile(const std::filesystem::path& file, const LightFile& lights);

// The count and "file x y z" a line: directions alone.
void saveLpFile(const std::filesystem::path& file, const LightFile& lights);

} // namespace nacre
