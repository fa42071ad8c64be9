#include "engine/scene/scene_description.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/scene/scene_names.h"

namespace nacre {
namespace fs = std::filesystem;
using SceneJson = nlohmann::ordered_json;

namespace {

constexpr int kVersion = 1;
constexpr const char* kFormat = "nacre scene";

// Visits every key with its value and the value that it has where a file does not say it: one list for reading and
// writing.
template <class Scene, class Visitor> void visitScene(Scene& scene, Visitor&& visit)
{
    const SceneDescription unsaid;
    visit("surface", scene.surface, unsaid.surface);
    visit("material", scene.material, unsaid.material);
    visit("onto", scene.onto, unsaid.onto);
    visit("turn", scene.turn, unsaid.turn);
    visit("normal-y", scene.normalY, unsaid.normalY);
    visit("size", scene.size, unsaid.size);
    visit("light", scene.lights, unsaid.lights);
    visit("environment", scene.environment, unsaid.environment);
    visit("environment-lights", scene.environmentLights, unsaid.environmentLights);
    visit("environment-turn", scene.environmentTurn, unsaid.environmentTurn);
    visit("view", scene.view, unsaid.view);
    visit("path", scene.path, unsaid.path);
    visit("exposure", scene.exposure, unsaid.exposure);
    std::string tone = nameOfToneCurve(scene.toneCurve);
    visit("tone", tone, nameOfToneCurve(unsaid.toneCurve));
    if constexpr (!std::is_const_v<Scene>) {
        scene.toneCurve = toneCurveFromName(tone);
    }
    visit("show", scene.show, unsaid.show);
    visit("frames", scene.frames, unsaid.frames);
    visit("motion", scene.motion, unsaid.motion);
    visit("shadows", scene.shadows, unsaid.shadows);
    visit("layer", scene.residual, unsaid.residual);
}

template <class Scene, class Visitor> void visitWindow(Scene& scene, Visitor&& visit)
{
    const SceneDescription unsaid;
    visit("zoom", scene.framing.zoom, unsaid.framing.zoom);
    visit("centre", scene.framing.centre, unsaid.framing.centre);
    visit("materials", scene.materials, unsaid.materials);
    visit("targets", scene.targets, unsaid.targets);
    visit("environments", scene.environments, unsaid.environments);
    visit("wipe-material", scene.wipe.material, unsaid.wipe.material);
    visit("wipe-at", scene.wipe.at, unsaid.wipe.at);
}

// Values as JSON and back, by their types.
class Values {
public:
    explicit Values(fs::path folder) : folder_(std::move(folder)) {}

    void read(const SceneJson& json, fs::path& value) const
    {
        const fs::path named = json.get<std::string>();
        value = isGenerated(named) ? named : folder_ / named;
    }
    void read(const SceneJson& json, std::string& value) const { value = json.get<std::string>(); }
    void read(const SceneJson& json, float& value) const { value = json.get<float>(); }
    void read(const SceneJson& json, int& value) const { value = json.get<int>(); }
    void read(const SceneJson& json, bool& value) const { value = json.get<bool>(); }
    void read(const SceneJson& json, NormalY& value) const { value = normalYFromName(json.get<std::string>()); }
    void read(const SceneJson& json, LightMotion& value) const { value = motionFromName(json.get<std::string>()); }
    void read(const SceneJson& json, RenderPath& value) const { value = pathFromName(json.get<std::string>()); }
    void read(const SceneJson& json, Show& value) const { value = showFromName(json.get<std::string>()); }
    void read(const SceneJson& json, ResidualUse& value) const { value = residualUseFromName(json.get<std::string>()); }
    void read(const SceneJson& json, LightSource& value) const { value = lightSourceFromText(json.get<std::string>()); }
    void read(const SceneJson& json, PictureSize& value) const
    {
        value = sizeFromArgument("size", json.get<std::string>());
    }
    void read(const SceneJson& json, Turn& value) const { value = turnFromText(json.get<std::string>()); }
    void read(const SceneJson& json, glm::vec3& value) const { value = viewFromText(json.get<std::string>()); }
    void read(const SceneJson& json, glm::vec2& value) const
    {
        value = {json.at(0).get<float>(), json.at(1).get<float>()};
    }
    template <class T> void read(const SceneJson& json, std::optional<T>& value) const { read(json, value.emplace()); }
    template <class T> void read(const SceneJson& json, std::vector<T>& values) const
    {
        for (const SceneJson& item : json.get_ref<const SceneJson::array_t&>()) { // throws where it is no array
            read(item, values.emplace_back());
        }
    }

    SceneJson written(const fs::path& value) const
    {
        if (isGenerated(value)) {
            return value.string();
        }
        const fs::path from = folder_.empty() ? fs::current_path() : fs::absolute(folder_);
        return fs::absolute(value).lexically_normal().lexically_proximate(from.lexically_normal()).string();
    }
    SceneJson written(const std::string& value) const { return value; }
    SceneJson written(float value) const { return value; }
    SceneJson written(int value) const { return value; }
    SceneJson written(bool value) const { return value; }
    SceneJson written(const LightSource& value) const { return textOf(value); }
    SceneJson written(const PictureSize& value) const { return fmt::format("{}x{}", value.width, value.height); }
    SceneJson written(const Turn& value) const { return textOf(value); }
    SceneJson written(const glm::vec3& value) const { return fmt::format("{},{},{}", value.x, value.y, value.z); }
    SceneJson written(const glm::vec2& value) const { return SceneJson::array({value.x, value.y}); }
    template <class T>
    requires std::is_enum_v<T> SceneJson written(T value)
    const { return nameOf(value); }
    template <class T> SceneJson written(const std::optional<T>& value) const { return written(*value); }
    template <class T> SceneJson written(const std::vector<T>& values) const
    {
        SceneJson list = SceneJson::array();
        for (const T& value : values) {
            list.push_back(written(value));
        }
        return list;
    }

private:
    fs::path folder_;
};

// Reads the keys that are visited and takes them out of the object.
auto readingFrom(SceneJson& json, const fs::path& folder)
{
    return [&json, values = Values(folder)](const char* key, auto& value, const auto&) {
        const auto found = json.find(key);
        if (found != json.end()) {
            values.read(*found, value);
            json.erase(found);
        }
    };
}

auto writingTo(SceneJson& json, const fs::path& folder)
{
    return [&json, values = Values(folder)](const char* key, const auto& value, const auto& unsaid) {
        if (value != unsaid) {
            json[key] = values.written(value);
        }
    };
}

void requireNothingLeft(const SceneJson& json, const fs::path& file, const char* expected)
{
    if (!json.empty()) {
        throw Error(file, fmt::format("has the unknown key '{}'", json.begin().key()), expected);
    }
}

fs::path absolutePath(const fs::path& path)
{
    fs::path whole = path.empty() || isGenerated(path) ? path : fs::absolute(path).lexically_normal();
    return whole.has_filename() || whole.empty() ? whole : whole.parent_path(); // without a slash at the end
}

// FILE, KIND:FILE, NAME.nacre and NAME.nacre#MATERIAL; formulas stay as they are.
std::string absoluteSpecification(const std::string& text)
{
    if (text.empty() || fs::exists(text)) {
        return absolutePath(text).string();
    }
    for (const std::string_view kind : {"merl:", "rgl:", "table:"}) {
        if (text.starts_with(kind)) {
            return std::string(kind) + absolutePath(text.substr(kind.size())).string();
        }
    }
    const size_t mark = text.rfind('#');
    const bool isOfSurface = mark != std::string::npos && fs::is_directory(text.substr(0, mark));
    return isOfSurface ? absolutePath(text.substr(0, mark)).string() + text.substr(mark) : text;
}

} // namespace

namespace {

// Of a mistake that was found in a value, about the file that holds it.
Error inFile(const fs::path& file, const Error& error)
{
    const std::string text = error.what();
    const size_t end = text.find("; ");
    return text.starts_with(file.string()) || end == std::string::npos
               ? error
               : Error(file, text.substr(0, end), text.substr(end + 2));
}

} // namespace

SceneDescription sceneFromFile(const fs::path& file)
{
    SceneDescription scene;
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
        visitWindow(scene, readingFrom(window, file.parent_path()));
        requireNothingLeft(json, file,
                           json.contains("residual") ? "'layer' in place of 'residual'"
                                                     : "the long options of nacre render");
        requireNothingLeft(window, file, "the keys of \"window\" in docs/formats.md");
    } catch (const SceneJson::exception& e) {
        throw Error(file, std::string("is not understood: ") + e.what(), "the form of docs/formats.md");
    } catch (const Error& e) {
        throw inFile(file, e);
    }
    return scene;
}

std::string textOf(const SceneDescription& scene, const fs::path& folder)
{
    SceneJson json{{"format", kFormat}, {"version", kVersion}};
    visitScene(scene, writingTo(json, folder));
    SceneJson window = SceneJson::object();
    visitWindow(scene, writingTo(window, folder));
    if (!window.empty()) {
        json["window"] = window;
    }
    return json.dump(2) + "\n";
}

glm::vec3 viewFromText(const std::string& text)
{
    const std::vector<float> numbers = numbersFromText(text);
    if (numbers.size() != 3 || !(numbers[2] > 0)) {
        throw Error("", fmt::format("view {} is no direction to see the front from", text),
                    "x,y,z towards the viewer, z above 0", Error::kUsage);
    }
    return {numbers[0], numbers[1], numbers[2]};
}

glm::vec3 viewDirectionOf(const SceneDescription& scene)
{
    return scene.view ? glm::vec3(glm::normalize(glm::dvec3(*scene.view))) : glm::vec3(0, 0, 1);
}

bool isGenerated(const fs::path& onto)
{
    return onto.string().starts_with("make:");
}

void makeAbsolute(SceneDescription& scene)
{
    for (fs::path* path : {&scene.surface, &scene.onto, &scene.environment}) {
        *path = absolutePath(*path);
    }
    for (std::vector<fs::path>* paths : {&scene.targets, &scene.environments}) {
        for (fs::path& path : *paths) {
            path = absolutePath(path);
        }
    }
    scene.material = absoluteSpecification(scene.material);
    scene.wipe.material = absoluteSpecification(scene.wipe.material);
    for (std::string& material : scene.materials) {
        material = absoluteSpecification(material);
    }
}

void resolveCaptured(SceneDescription& scene, std::span<const CapturedLight> captured)
{
    if (scene.lights.empty() && scene.environment.empty() && scene.rig.empty()) {
        scene.lights = {defaultLightSource(captured)};
    }
    for (LightSource& source : scene.lights) {
        if (source.captured > 0) {
            const Light light = lightOf(source, captured);
            source.direction = light.direction;
            source.irradiance = light.irradiance;
            source.distance = light.distance;
        }
    }
}

std::optional<size_t> shownPhotograph(const SceneDescription& scene)
{
    const bool isAlone = scene.lights.size() == 1 && scene.environment.empty();
    const bool isOwn = !scene.surface.empty() && scene.material.empty() && scene.onto.empty() && scene.turn == Turn();
    if (!isAlone || !isOwn || scene.lights[0].captured < 1) {
        return {};
    }
    return static_cast<size_t>(scene.lights[0].captured - 1);
}

} // namespace nacre
