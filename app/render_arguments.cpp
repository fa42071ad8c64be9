#include "app/render_arguments.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/error.h"
#include "engine/scene/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kVersion = 1;

void fill(std::string& value, const Json& json)
{
    if (value.empty()) {
        value = json.get<std::string>();
    }
}

template <class Number> void fill(std::optional<Number>& value, const Json& json)
{
    if (!value) {
        value = json.get<Number>();
    }
}

void fillPath(fs::path& value, const Json& json, const fs::path& folder)
{
    if (value.empty()) {
        value = folder / json.get<std::string>();
    }
}

void fillFrom(RenderArguments& a, const std::string& key, const Json& json)
{
    const fs::path folder = a.state.parent_path();
    if (key == "surface") {
        fillPath(a.surface, json, folder);
    } else if (key == "onto") {
        fillPath(a.onto, json, folder);
    } else if (key == "environment") {
        fillPath(a.environment, json, folder);
    } else if (key == "material") {
        fill(a.material, json);
    } else if (key == "normal-y") {
        fill(a.normalY, json);
    } else if (key == "size") {
        fill(a.size, json);
    } else if (key == "light") {
        a.lights = a.lights.empty() ? json.get<std::vector<std::string>>() : a.lights;
    } else if (key == "environment-lights") {
        fill(a.environmentLights, json);
    } else if (key == "environment-turn") {
        fill(a.environmentTurn, json);
    } else if (key == "view") {
        fill(a.view, json);
    } else if (key == "path") {
        fill(a.path, json);
    } else if (key == "exposure") {
        fill(a.exposure, json);
    } else if (key == "tone") {
        fill(a.tone, json);
    } else if (key == "frames") {
        fill(a.frames, json);
    } else if (key == "motion") {
        fill(a.motion, json);
    } else if (key != "format" && key != "version") {
        throw Error(a.state, fmt::format("has the unknown key '{}'", key), "the long options of nacre render");
    }
}

} // namespace

void completeFromState(RenderArguments& arguments)
{
    if (arguments.state.empty()) {
        return;
    }
    try {
        const Json json = Json::parse(readTextFile(arguments.state));
        if (!json.is_object() || json.value("format", "") != "nacre scene" || json.value("version", 0) != kVersion) {
            throw Error(arguments.state, "is no scene", R"("format": "nacre scene", "version": 1)");
        }
        for (const auto& [key, value] : json.items()) {
            fillFrom(arguments, key, value);
        }
    } catch (const Json::exception& e) {
        throw Error(arguments.state, std::string("is not understood: ") + e.what(), "the form of docs/formats.md");
    }
}

} // namespace nacre
