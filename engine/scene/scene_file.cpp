#include "engine/scene/scene_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;
using SceneJson = nlohmann::ordered_json;

namespace {

constexpr int kVersion = 1;
constexpr const char* kFormat = "nacre scene";

// Visits every key with its value, one list for reading and writing.
template <class Scene, class Visitor> void visitScene(Scene& scene, Visitor&& visit)
{
    visit("surface", scene.surface);
    visit("material", scene.material);
    visit("onto", scene.onto);
    visit("normal-y", scene.normalY);
    visit("size", scene.size);
    visit("light", scene.lights);
    visit("environment", scene.environment);
    visit("environment-lights", scene.environmentLights);
    visit("environment-turn", scene.environmentTurn);
    visit("view", scene.view);
    visit("path", scene.path);
    visit("exposure", scene.exposure);
    visit("tone", scene.tone);
    visit("show", scene.show);
    visit("frames", scene.frames);
    visit("motion", scene.motion);
    visit("shadows", scene.shadows);
    visit("layer", scene.residual);
}

template <class Window, class Visitor> void visitWindow(Window& window, Visitor&& visit)
{
    visit("zoom", window.zoom);
    visit("centre", window.centre);
    visit("materials", window.materials);
    visit("targets", window.targets);
    visit("environments", window.environments);
    visit("wipe-material", window.wipeMaterial);
    visit("wipe-at", window.wipeAt);
}

bool isEmpty(const auto& value)
{
    if constexpr (requires { value.has_value(); }) {
        return !value.has_value();
    } else {
        return value.empty();
    }
}

void read(std::string& value, const SceneJson& json, const fs::path&)
{
    value = json.get<std::string>();
}

void read(fs::path& value, const SceneJson& json, const fs::path& folder)
{
    value = folder / json.get<std::string>();
}

template <class Number> void read(std::optional<Number>& value, const SceneJson& json, const fs::path&)
{
    value = json.get<Number>();
}

template <class Element> void read(std::vector<Element>& values, const SceneJson& json, const fs::path& folder)
{
    for (const SceneJson& item : json.get_ref<const SceneJson::array_t&>()) { // throws where it is no array
        if constexpr (std::is_same_v<Element, fs::path>) {
            values.push_back(folder / item.get<std::string>());
        } else {
            values.push_back(item.get<Element>());
        }
    }
}

// Reads the keys that `visit` knows and takes them out of the object.
auto readingFrom(SceneJson& json, const fs::path& folder)
{
    return [&json, folder](const char* key, auto& value) {
        const auto found = json.find(key);
        if (found != json.end()) {
            if (isEmpty(value)) {
                read(value, *found, folder);
            }
            json.erase(found);
        }
    };
}

void requireNothingLeft(const SceneJson& json, const fs::path& file, const char* expected)
{
    if (!json.empty()) {
        throw Error(file, fmt::format("has the unknown key '{}'", json.begin().key()), expected);
    }
}

std::string written(const fs::path& value, const fs::path& folder)
{
    const fs::path from = folder.empty() ? fs::current_path() : fs::absolute(folder);
    return fs::absolute(value).lexically_normal().lexically_proximate(from.lexically_normal()).string();
}

auto writingTo(SceneJson& json, const fs::path& folder)
{
    return [&json, folder](const char* key, const auto& value) {
        using Value = std::remove_cvref_t<decltype(value)>;
        if (isEmpty(value)) {
            return;
        }
        if constexpr (std::is_same_v<Value, fs::path>) {
            json[key] = written(value, folder);
        } else if constexpr (std::is_same_v<Value, std::vector<fs::path>>) {
            for (const fs::path& path : value) {
                json[key].push_back(written(path, folder));
            }
        } else if constexpr (requires { value.value(); }) {
            json[key] = *value;
        } else {
            json[key] = value;
        }
    };
}

} // namespace

void completeScene(SceneFile& scene, const fs::path& file)
{
    try {
        SceneJson json = SceneJson::parse(readTextFile(file));
        if (!json.is_object() || json.value("format", "") != kFormat || json.value("version", 0) != kVersion) {
            throw Error(file, "is no scene", R"("format": "nacre scene", "version": 1)");
        }
        json.erase("format");
        json.erase("version");
        SceneJson window = json.value("window", SceneJson::object());
        json.erase("window");
        visitScene(scene, readingFrom(json, file.parent_path()));
        visitWindow(scene.window, readingFrom(window, file.parent_path()));
        requireNothingLeft(json, file, "the long options of nacre render");
        requireNothingLeft(window, file, "the keys of \"window\" in docs/formats.md");
    } catch (const SceneJson::exception& e) {
        throw Error(file, std::string("is not understood: ") + e.what(), "the form of docs/formats.md");
    }
}

std::string textOf(const SceneFile& scene, const fs::path& folder)
{
    SceneJson json{{"format", kFormat}, {"version", kVersion}};
    visitScene(scene, writingTo(json, folder));
    SceneJson window = SceneJson::object();
    visitWindow(scene.window, writingTo(window, folder));
    if (!window.empty()) {
        json["window"] = window;
    }
    return json.dump(2) + "\n";
}

} // namespace nacre
