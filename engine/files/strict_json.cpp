#include "engine/files/strict_json.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/whole_file.h"

namespace nacre {
using nlohmann::json;

namespace {

std::string joined(std::initializer_list<std::string_view> keys)
{
    std::string list;
    for (const std::string_view key : keys) {
        list += fmt::format("{}{}", list.empty() ? "" : ", ", key);
    }
    return list;
}

json parsed(const std::filesystem::path& file)
{
    try {
        return json::parse(readTextFile(file));
    } catch (const json::exception& error) {
        const std::string what = error.what(); // "[json.exception.parse_error.101] parse error at line 1, ..."
        const size_t start = what.find("] ");
        throw Error(file, "is not JSON: " + (start == std::string::npos ? what : what.substr(start + 2)), "valid JSON");
    }
}

} // namespace

JsonNode JsonNode::load(const std::filesystem::path& file)
{
    return {std::make_shared<std::filesystem::path>(file), std::make_shared<json>(parsed(file)), ""};
}

JsonNode JsonNode::loadVersioned(const std::filesystem::path& file, std::string_view format, int version)
{
    JsonNode root = load(file);
    const JsonNode formatNode = root.at("format");
    if (formatNode.text() != format) {
        throw formatNode.error(fmt::format("is \"{}\"", formatNode.text()), fmt::format("\"{}\"", format));
    }
    const JsonNode versionNode = root.at("version");
    const double found = versionNode.number();
    if (found < 1 || found > version || found != std::floor(found)) {
        throw versionNode.error(fmt::format("is {}", found), fmt::format("at most {}, the newest known here", version));
    }
    return root;
}

JsonNode JsonNode::child(const json& value, std::string place) const
{
    return {file_, std::shared_ptr<const json>(value_, &value), std::move(place)};
}

Error JsonNode::error(std::string_view wrong, std::string_view expected) const
{
    return {*file_, place_.empty() ? std::string(wrong) : fmt::format("{} {}", place_, wrong), std::string(expected)};
}

Error JsonNode::wrongType(std::string_view expected) const
{
    return error(fmt::format("is {} {}", value_->is_array() || value_->is_object() ? "an" : "a", value_->type_name()),
                 expected);
}

const json& JsonNode::object() const
{
    if (!value_->is_object()) {
        throw wrongType("an object");
    }
    return *value_;
}

bool JsonNode::has(std::string_view key) const
{
    return object().contains(std::string(key));
}

void JsonNode::allowKeys(std::initializer_list<std::string_view> keys) const
{
    for (const auto& [key, unused] : object().items()) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            throw error(fmt::format("has the unknown key \"{}\"", key), "one of " + joined(keys));
        }
    }
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const
{
    const auto found = object().find(std::string(key));
    if (found == object().end()) {
        return std::nullopt;
    }
    return child(*found, place_.empty() ? std::string(key) : fmt::format("{}.{}", place_, key));
}

JsonNode JsonNode::at(std::string_view key) const
{
    const auto found = find(key);
    if (!found) {
        throw error(fmt::format("lacks \"{}\"", key), "that key");
    }
    return *found;
}

std::string JsonNode::text() const
{
    if (!value_->is_string()) {
        throw wrongType("a string");
    }
    return value_->get<std::string>();
}

double JsonNode::number() const
{
    if (!value_->is_number()) {
        throw wrongType("a number");
    }
    const double number = value_->get<double>();
    if (!std::isfinite(number)) {
        throw error("is not finite", "a finite number");
    }
    return number;
}

int JsonNode::whole(int least, int most) const
{
    const double found = number();
    if (found < least || found > most || found != std::floor(found)) {
        throw error(fmt::format("is {}", found), fmt::format("a whole number from {} to {}", least, most));
    }
    return static_cast<int>(found);
}

bool JsonNode::truth() const
{
    if (!value_->is_boolean()) {
        throw wrongType("true or false");
    }
    return value_->get<bool>();
}

std::vector<JsonNode> JsonNode::items() const
{
    if (!value_->is_array()) {
        throw wrongType("an array");
    }
    std::vector<JsonNode> nodes;
    for (const json& item : *value_) {
        nodes.push_back(child(item, fmt::format("{}[{}]", place_, nodes.size())));
    }
    return nodes;
}

std::vector<double> JsonNode::numbers(size_t count) const
{
    std::vector<double> result;
    for (const JsonNode& item : items()) {
        result.push_back(item.number());
    }
    if (result.size() != count) {
        throw error(fmt::format("has {} numbers", result.size()), fmt::format("{} numbers", count));
    }
    return result;
}

std::vector<float> JsonNode::floats(size_t count) const
{
    const std::vector<double> found = numbers(count);
    return {found.begin(), found.end()};
}

glm::vec3 JsonNode::vector3() const
{
    const std::vector<double> v = numbers(3);
    return {v[0], v[1], v[2]};
}

std::filesystem::path JsonNode::existingPath() const
{
    std::filesystem::path path = file_->parent_path() / text();
    if (text().empty() || !std::filesystem::exists(path)) {
        throw error(fmt::format("names \"{}\", which does not exist", text()), "a path relative to this file");
    }
    return path;
}

} // namespace nacre
