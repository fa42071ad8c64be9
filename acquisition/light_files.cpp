#include "acquisition/light_files.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/picture_files.h"
#include "acquisition/strict_json.h"
#include "acquisition/text_files.h"
#include "engine/scene/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kLightsVersion = 1;
constexpr std::string_view kLightsFormat = "nacre lights";
constexpr const char* kDirection = "a vector towards the light, of any length but 0";
constexpr const char* kIrradiance = "three positive numbers";

bool isDirection(const glm::vec3& v)
{
    const double length = glm::length(glm::dvec3(v));
    return length > 0 && std::isfinite(length);
}

bool isIrradiance(const glm::vec3& e)
{
    return e.x > 0 && e.y > 0 && e.z > 0 && std::isfinite(e.x + e.y + e.z);
}

// In double, so that vectors of any length keep a direction.
glm::vec3 normalized(const glm::vec3& v)
{
    return glm::vec3(glm::normalize(glm::dvec3(v)));
}

std::string described(const glm::vec3& v)
{
    return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

std::vector<glm::vec3> vectorsOf(const fs::path& file, const NumberTable& rows)
{
    std::vector<glm::vec3> vectors;
    if (rows[0].size() == 3) {
        for (const auto& row : rows) {
            vectors.emplace_back(row[0], row[1], row[2]);
        }
    } else if (rows.size() == 3) {
        for (size_t i = 0; i < rows[0].size(); ++i) {
            vectors.emplace_back(rows[0][i], rows[1][i], rows[2][i]);
        }
    } else {
        throw Error(file, fmt::format("has {} rows of {} numbers", rows.size(), rows[0].size()),
                    "three numbers a line, or three lines");
    }
    return vectors;
}

LightFile loadLightsJson(const fs::path& file)
{
    const JsonNode root = JsonNode::loadVersioned(file, kLightsFormat, kLightsVersion);
    root.allowKeys({"format", "version", "lights"});
    const std::vector<JsonNode> nodes = root.at("lights").items();
    LightFile result;
    for (const JsonNode& node : nodes) {
        node.allowKeys({"photograph", "direction", "irradiance"});
        if (node.has("photograph") != nodes[0].has("photograph") ||
            node.has("irradiance") != nodes[0].has("irradiance")) {
            throw node.error("has other keys than lights[0]",
                             "a photograph and an irradiance for all lights or for none");
        }
        Light light{directionOf(node.at("direction")), glm::vec3(1)};
        if (const auto irradiance = node.find("irradiance")) {
            light.irradiance = irradianceOf(*irradiance);
            result.irradianceGiven = true;
        }
        if (const auto photograph = node.find("photograph")) {
            result.photographs.push_back(photograph->text());
        }
        result.lights.push_back(light);
    }
    return result;
}

} // namespace

LightFile loadLightFile(const fs::path& file)
{
    const std::string extension = lowerCase(file.extension().string());
    if (extension == ".lp") {
        return loadLpFile(file);
    }
    if (extension == ".json") {
        return loadLightsJson(file);
    }
    LightFile result;
    for (const glm::vec3& direction : loadDirections(file)) {
        result.lights.push_back({direction, glm::vec3(1)});
    }
    return result;
}

LightFile loadLpFile(const fs::path& file)
{
    const std::vector<std::string> lines = loadTextLines(file);
    if (lines.empty()) {
        throw Error(file, "is empty", "a count, then \"file x y z\" a line");
    }
    const size_t announced = parseCount(file, lines[0]);
    requireAnnouncedCount(file, announced, lines.size() - 1);
    LightFile result;
    for (size_t i = 1; i < lines.size(); ++i) {
        std::string_view name = lines[i];
        glm::vec3 v(0);
        for (int axis = 2; axis >= 0; --axis) {
            const auto number = parseNumber(takeLastToken(name));
            if (!number || name.empty()) {
                throw Error(file, fmt::format("\"{}\" is no photograph with its light", lines[i]), "\"file x y z\"");
            }
            v[axis] = static_cast<float>(*number);
        }
        if (!isDirection(v)) {
            throw Error(file, fmt::format("the light of {} is {}", name, described(v)), kDirection);
        }
        result.photographs.emplace_back(name);
        result.lights.push_back({normalized(v), glm::vec3(1)});
    }
    return result;
}

std::vector<glm::vec3> loadDirections(const fs::path& file)
{
    std::vector<glm::vec3> directions = vectorsOf(file, loadNumberTable(file));
    for (glm::vec3& v : directions) {
        if (!isDirection(v)) {
            throw Error(file, fmt::format("light {} is {}", &v - directions.data() + 1, described(v)), kDirection);
        }
        v = normalized(v);
    }
    return directions;
}

std::vector<glm::vec3> loadIrradiances(const fs::path& file)
{
    const NumberTable rows = loadNumberTable(file);
    std::vector<glm::vec3> irradiances;
    if (rows.size() == 1 || rows[0].size() == 1) {
        for (const auto& row : rows) {
            for (const double grey : row) {
                irradiances.emplace_back(grey);
            }
        }
    } else {
        irradiances = vectorsOf(file, rows);
    }
    for (const glm::vec3& e : irradiances) {
        if (!isIrradiance(e)) {
            throw Error(file, fmt::format("light {} has the irradiance {}", &e - irradiances.data() + 1, described(e)),
                        kIrradiance);
        }
    }
    return irradiances;
}

glm::vec3 directionOf(const JsonNode& node)
{
    const glm::vec3 v = node.vector3();
    if (!isDirection(v)) {
        throw node.error("is " + described(v), kDirection);
    }
    return normalized(v);
}

glm::vec3 irradianceOf(const JsonNode& node)
{
    const glm::vec3 e = node.vector3();
    if (!isIrradiance(e)) {
        throw node.error("is " + described(e), kIrradiance);
    }
    return e;
}

void saveLightFile(const fs::path& file, const LightFile& lights)
{
    using nlohmann::json;
    json list = json::array();
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const auto& [direction, irradiance] = lights.lights[i];
        json light{{"direction", {direction.x, direction.y, direction.z}}};
        if (!lights.photographs.empty()) {
            light["photograph"] = lights.photographs[i];
        }
        if (lights.irradianceGiven) {
            light["irradiance"] = {irradiance.x, irradiance.y, irradiance.z};
        }
        list.push_back(std::move(light));
    }
    const json root{{"format", kLightsFormat}, {"version", kLightsVersion}, {"lights", std::move(list)}};
    writeTextFile(file, root.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

} // namespace nacre
