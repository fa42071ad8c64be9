#pragma once
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"

namespace nacre {

// A value in a JSON file that knows where it stands, so that every complaint names file and place, for instance
// "photographs[3].light.direction".
class JsonNode {
public:
    // The root of any JSON.
    static JsonNode load(const std::filesystem::path& file);
    // The root, an object with "format" and a "version" from 1 to `version`.
    static JsonNode loadVersioned(const std::filesystem::path& file, std::string_view format, int version);

    const std::filesystem::path& file() const { return *file_; }
    bool isText() const { return value_->is_string(); }
    bool has(std::string_view key) const;

    // Refuses any other key.
    void allowKeys(std::initializer_list<std::string_view> keys) const;
    JsonNode at(std::string_view key) const;
    std::optional<JsonNode> find(std::string_view key) const;

    std::string text() const;
    double number() const; // finite
    int whole(int least, int most) const;
    bool truth() const; // true or false
    std::vector<JsonNode> items() const;
    std::vector<double> numbers(size_t count) const; // an array of as many
    std::vector<float> floats(size_t count) const;
    glm::vec3 vector3() const;
    // A path relative to the JSON file, and something is there.
    std::filesystem::path existingPath() const;

    Error error(std::string_view wrong, std::string_view expected) const;

private:
    JsonNode(std::shared_ptr<const std::filesystem::path> file, std::shared_ptr<const nlohmann::json> value,
             std::string place)
        : file_(std::move(file)), value_(std::move(value)), place_(std::move(place))
    {
    }
    JsonNode child(const nlohmann::json& value, std::string place) const;
    const nlohmann::json& object() const;
    Error wrongType(std::string_view expected) const;

    std::shared_ptr<const std::filesystem::path> file_;
    std::shared_ptr<const nlohmann::json> value_; // shares the ownership of the whole document
    std::string place_;                           // empty for the root
};

} // namespace nacre
