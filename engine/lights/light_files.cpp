#include "engine/lights/light_files.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/strict_json.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/lights/npy_file.h"

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

// Whether a number of its own, from 0 or 1, stands before each light's three.
bool isNumbered(const NumberTable& rows)
{
    const double first = rows[0][0];
    bool counts = rows[0].size() == 4 && rows.size() > 1 && (first == 0 || first == 1);
    for (size_t i = 0; i < rows.size() && counts; ++i) {
        counts = rows[i][0] == first + static_cast<double>(i);
    }
    return counts;
}

LightFile lightsOf(const fs::path& file, std::vector<glm::vec3> vectors)
{
    LightFile result;
    for (const glm::vec3& v : vectors) {
        if (!isDirection(v)) {
            throw Error(file, fmt::format("light {} is {}", &v - vectors.data() + 1, described(v)), kDirection);
        }
        result.lights.push_back({normalized(v), glm::vec3(1)});
    }
    result.vectors = std::move(vectors);
    return result;
}

LightFile loadLightsJson(const fs::path& file)
{
    const JsonNode root = JsonNode::loadVersioned(file, kLightsFormat, kLightsVersion);
    root.allowKeys({"format", "version", "lights"});
    const std::vector<JsonNode> nodes = root.at("lights").items();
    LightFile result;
    for (const JsonNode& node : nodes) {
        node.allowKeys({"photograph", "direction", "irradiance", "distance"});
        if (node.has("photograph") != nodes[0].has("photograph") ||
            node.has("irradiance") != nodes[0].has("irradiance") || node.has("distance") != nodes[0].has("distance")) {
            throw node.error("has other keys than lights[0]",
                             "a photograph, an irradiance and a distance for all lights or for none");
        }
        Light light{directionOf(node.at("direction")), glm::vec3(1)};
        result.vectors.push_back(node.at("direction").vector3());
        if (const auto irradiance = node.find("irradiance")) {
            light.irradiance = irradianceOf(*irradiance);
            result.irradianceGiven = true;
        }
        if (const auto distance = node.find("distance")) {
            light.distance = lightDistanceOf(*distance);
        }
        if (const auto photograph = node.find("photograph")) {
            result.photographs.push_back(photograph->text());
        }
        result.lights.push_back(light);
    }
    return result;
}

// The first matrix of an OpenCV FileStorage in YAML: its data in rows of three.
LightFile loadOpenCvMatrix(const fs::path& file)
{
    constexpr const char* kMatrix = "a matrix of OpenCV with three columns or three rows";
    const std::string text = readTextFile(file);
    const size_t data = text.find("data:"), first = text.find('[', data), last = text.find(']', first),
                 columns = text.find("cols:");
    if (data == std::string::npos || last == std::string::npos || columns == std::string::npos) {
        throw Error(file, "holds no matrix", kMatrix);
    }
    const size_t across = std::max<size_t>(1, std::strtoul(&text[columns + 5], nullptr, 10));
    std::string list = text.substr(first + 1, last - first - 1);
    std::replace_if(
        list.begin(), list.end(), [](char c) { return c == ',' || c == '\n' || c == '\r'; }, ' ');
    const NumbersAtEnd all = takeNumbersFromEnd(list, std::string_view::npos);
    if (!all.rest.empty() || all.numbers.empty() || all.numbers.size() % across != 0) {
        throw Error(file, fmt::format("has {} numbers in {} columns", all.numbers.size(), across), kMatrix);
    }
    NumberTable rows;
    for (auto row = all.numbers.begin(); row != all.numbers.end(); row += static_cast<std::ptrdiff_t>(across)) {
        rows.emplace_back(row, row + static_cast<std::ptrdiff_t>(across));
    }
    return lightsOf(file, vectorsOf(file, rows));
}

} // namespace

namespace {

struct LpLine {
    std::string_view photograph;
    glm::vec3 vector;
    std::optional<double> irradiance;
};

// "file x y z", or "file x y z irradiance" where what stands before four numbers ends as a file's name; empty where it
// is neither.
std::optional<LpLine> parseLpLine(std::string_view line)
{
    const NumbersAtEnd last = takeNumbersFromEnd(line, 3);
    if (last.numbers.size() < 3 || last.rest.empty()) {
        return std::nullopt;
    }
    const std::vector<double>& n = last.numbers;
    const NumbersAtEnd first = takeNumbersFromEnd(last.rest, 1);
    if (first.numbers.empty() || !fs::path(first.rest).has_extension()) {
        return LpLine{last.rest, glm::vec3(n[0], n[1], n[2]), {}};
    }
    return LpLine{first.rest, glm::vec3(first.numbers[0], n[0], n[1]), n[2]};
}

// Of a line whose list began with `first`.
Light lightOf(const fs::path& file, const LpLine& line, const std::optional<LpLine>& first)
{
    if (!isDirection(line.vector)) {
        throw Error(file, fmt::format("the light of {} is {}", line.photograph, described(line.vector)), kDirection);
    }
    const glm::vec3 irradiance(line.irradiance.value_or(1));
    if (!isIrradiance(irradiance) || (first && first->irradiance.has_value() != line.irradiance.has_value())) {
        throw Error(file,
                    fmt::format("the fourth number of {} is {}", line.photograph,
                                line.irradiance ? fmt::format("{}", *line.irradiance) : "missing"),
                    "an irradiance above 0 for all photographs or for none");
    }
    return {normalized(line.vector), irradiance};
}

std::string_view unquoted(std::string_view name)
{
    const bool isQuoted =
        name.size() > 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front();
    return isQuoted ? name.substr(1, name.size() - 2) : name;
}

LightFile lightsOfLp(const fs::path& file, const std::vector<std::string>& lines)
{
    if (lines.empty()) {
        throw Error(file, "is empty", "a count, then \"file x y z\" a line");
    }
    const bool counted = !parseLpLine(lines[0]);
    if (counted) {
        requireAnnouncedCount(file, parseCount(file, lines[0]), lines.size() - 1);
    }
    LightFile result;
    for (size_t i = counted ? 1 : 0; i < lines.size(); ++i) {
        const std::optional<LpLine> line = parseLpLine(lines[i]);
        if (!line) {
            throw Error(file, fmt::format("\"{}\" is no photograph with its light", lines[i]), "\"file x y z\"");
        }
        result.lights.push_back(lightOf(file, *line, parseLpLine(lines[counted ? 1 : 0])));
        result.photographs.emplace_back(unquoted(line->photograph));
        result.vectors.push_back(line->vector);
        result.irradianceGiven = line->irradiance.has_value();
    }
    return result;
}

// Whether words stand before each line's numbers.
bool namesPhotographs(const std::vector<std::string>& lines)
{
    return !lines.empty() && std::all_of(lines.begin(), lines.end(), [](const std::string& text) {
        const std::optional<LpLine> line = parseLpLine(text);
        return line && !takeNumbersFromEnd(line->photograph, std::string_view::npos).rest.empty();
    });
}

} // namespace

LightFile loadLpFile(const fs::path& file)
{
    return lightsOfLp(file, loadTextLines(file));
}

LightFile loadLpList(const fs::path& file)
{
    const std::vector<std::string> lines = loadTextLines(file);
    if (lines.empty() || std::any_of(lines.begin(), lines.end(), [](const auto& l) { return parseLpLine(l); })) {
        return loadLpFile(file);
    }
    const bool counted = parseNumber(lines[0]).has_value();
    if (counted) {
        requireAnnouncedCount(file, parseCount(file, lines[0]), lines.size() - 1);
    }
    LightFile result;
    result.photographs.assign(lines.begin() + (counted ? 1 : 0), lines.end());
    return result;
}

LightFile loadDirectionTable(const fs::path& file)
{
    NumberTable rows = loadNumberTable(file);
    if (isNumbered(rows)) {
        for (std::vector<double>& row : rows) {
            row.erase(row.begin());
        }
    }
    return lightsOf(file, vectorsOf(file, rows));
}

LightFile loadLightFile(const fs::path& file)
{
    const std::string extension = lowerCase(file.extension().string());
    if (extension == ".yml" || extension == ".yaml") {
        return loadOpenCvMatrix(file);
    }
    if (extension == ".npy") {
        return lightsOf(file, vectorsOf(file, loadNpyTable(file)));
    }
    if (extension == ".lp") {
        return loadLpFile(file);
    }
    if (extension == ".json") {
        return loadLightsJson(file);
    }
    const std::vector<std::string> lines = loadTableLines(file);
    return namesPhotographs(lines) ? lightsOfLp(file, lines) : loadDirectionTable(file);
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

float lightDistanceOf(const JsonNode& node)
{
    if (!(node.number() >= kNearestLight)) {
        throw node.error(fmt::format("is {:g}, inside the object", node.number()),
                         fmt::format("{} widths of the object or more", kNearestLight));
    }
    return static_cast<float>(node.number());
}

void saveLightFile(const fs::path& file, const LightFile& lights)
{
    using nlohmann::json;
    json list = json::array();
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const glm::vec3 &direction = lights.lights[i].direction, &irradiance = lights.lights[i].irradiance;
        json light{{"direction", {direction.x, direction.y, direction.z}}};
        if (!lights.photographs.empty()) {
            light["photograph"] = lights.photographs[i];
        }
        if (lights.irradianceGiven) {
            light["irradiance"] = {irradiance.x, irradiance.y, irradiance.z};
        }
        if (std::isfinite(lights.lights[i].distance)) {
            light["distance"] = lights.lights[i].distance;
        }
        list.push_back(std::move(light));
    }
    const json root{{"format", kLightsFormat}, {"version", kLightsVersion}, {"lights", std::move(list)}};
    writeTextFile(file, root.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

void saveLpFile(const fs::path& file, const LightFile& lights)
{
    std::string text = fmt::format("{}\n", lights.lights.size());
    for (size_t i = 0; i < lights.lights.size(); ++i) {
        const glm::vec3& d = lights.lights[i].direction;
        text += fmt::format("{} {:.7f} {:.7f} {:.7f}\n", lights.photographs[i], d.x, d.y, d.z);
    }
    writeTextFile(file, text);
}

} // namespace nacre
