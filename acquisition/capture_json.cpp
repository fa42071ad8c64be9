// Our own layout, docs/formats.md.
#include <fmt/format.h>

#include "acquisition/capture_layouts.h"
#include "acquisition/json_photographs.h"
#include "acquisition/strict_json.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kCaptureVersion = 1;

// Throws Error where `node` has `key` and the first of its kind has not, or the other way round.
void requireAlike(const JsonNode& node, bool has, bool firstHas, const char* what)
{
    if (has != firstHas) {
        throw node.error(fmt::format("{} {}, unlike the first", has ? "has" : "lacks", what), "it for all or for none");
    }
}

// The "light" of each photograph; none where no photograph has one.
LightFile lightsBeside(const std::vector<JsonNode>& photographs)
{
    const auto lightOf = [](const JsonNode& node) { return node.isText() ? std::nullopt : node.find("light"); };
    LightFile lights;
    for (const JsonNode& photograph : photographs) {
        const auto light = lightOf(photograph);
        requireAlike(photograph, light.has_value(), lightOf(photographs[0]).has_value(), "a light");
        if (!light) {
            continue;
        }
        light->allowKeys({"direction", "irradiance"});
        const auto irradiance = light->find("irradiance");
        requireAlike(*light, irradiance.has_value(), lightOf(photographs[0])->has("irradiance"), "an irradiance");
        lights.irradianceGiven = irradiance.has_value();
        lights.lights.push_back(
            {directionOf(light->at("direction")), irradiance ? irradianceOf(*irradiance) : glm::vec3(1)});
    }
    return lights;
}

SpherePhotographs sphereOf(const JsonNode& node)
{
    node.allowKeys({"photographs", "mask", "circle"});
    SpherePhotographs sphere;
    sphere.source = node.file();
    sphere.photographs = readPhotographs(node.at("photographs").items(), false).photographs;
    const auto mask = node.find("mask");
    const auto circle = node.find("circle");
    if (mask.has_value() == circle.has_value()) {
        throw node.error(mask ? "has a mask and a circle" : "has neither mask nor circle", "one of the two");
    }
    if (mask) {
        sphere.maskFile = mask->existingPath();
        return sphere;
    }
    const std::vector<double> numbers = circle->numbers(3);
    if (!(numbers[2] > 0)) {
        throw circle->error(fmt::format("has the radius {}", numbers[2]), "x, y and a positive radius");
    }
    sphere.circle = Circle{numbers[0], numbers[1], numbers[2]};
    return sphere;
}

void addIrradiances(LightFile& lights, const JsonNode& node)
{
    const fs::path file = node.existingPath();
    if (lights.lights.empty() || lights.irradianceGiven) {
        throw node.error(lights.irradianceGiven ? "comes beside irradiances of the lights" : "comes without directions",
                         "directions from \"lights\" or \"light\", and one source of irradiances");
    }
    const std::vector<glm::vec3> irradiances = loadIrradiances(file);
    if (irradiances.size() != lights.lights.size()) {
        throw Error(file, fmt::format("has {} lights, the directions are {}", irradiances.size(), lights.lights.size()),
                    "as many");
    }
    for (size_t i = 0; i < irradiances.size(); ++i) {
        lights.lights[i].irradiance = irradiances[i];
    }
    lights.irradianceGiven = true;
}

void readLights(const JsonNode& root, const std::vector<JsonNode>& photographs, LayoutContents& contents)
{
    LightFile lights = lightsBeside(photographs);
    fs::path source = root.file();
    if (const auto node = root.find("lights")) {
        if (!lights.lights.empty()) {
            throw node->error("comes beside lights of the photographs", "one of the two");
        }
        source = node->existingPath();
        lights = loadLightFile(source);
    }
    if (const auto node = root.find("irradiances")) {
        addIrradiances(lights, *node);
    }
    if (!lights.lights.empty()) {
        assignLights(contents, lights, source);
    }
}

TransferCurve transferOf(const JsonNode& node)
{
    const std::string name = node.text();
    if (name != "linear" && name != "srgb") {
        throw node.error(fmt::format("is \"{}\"", name), "\"linear\" or \"srgb\"");
    }
    return name == "srgb" ? TransferCurve::srgb : TransferCurve::linear;
}

} // namespace

std::optional<LayoutContents> readJsonLayout(const fs::path& folder)
{
    const fs::path file = folder / "capture.json";
    if (!fs::exists(file)) {
        return std::nullopt;
    }
    const JsonNode root = JsonNode::loadVersioned(file, "nacre capture", kCaptureVersion);
    root.allowKeys({"format", "version", "name", "transfer", "mask", "truthNormals", "lights", "irradiances",
                    "photographs", "mirrorSphere", "diffuseSphere"});
    LayoutContents contents;
    Capture& capture = contents.capture;
    capture.layout = CaptureLayout::json;
    contents.listing = file;
    const std::vector<JsonNode> photographs = root.at("photographs").items();
    const JsonPhotographs read = readPhotographs(photographs, true);
    capture.photographs = read.photographs;
    contents.exposuresGiven = read.exposuresGiven;
    readLights(root, photographs, contents);
    if (const auto name = root.find("name")) {
        capture.name = name->text();
    }
    if (const auto transfer = root.find("transfer")) {
        contents.transfer = transferOf(*transfer);
    }
    if (const auto mask = root.find("mask")) {
        contents.masks = {mask->existingPath()};
    }
    if (const auto truth = root.find("truthNormals")) {
        capture.truthNormals = truth->existingPath();
    }
    if (const auto sphere = root.find("mirrorSphere")) {
        capture.mirrorSphere = sphereOf(*sphere);
    }
    if (const auto sphere = root.find("diffuseSphere")) {
        capture.diffuseSphere = sphereOf(*sphere);
    }
    return contents;
}

} // namespace nacre
