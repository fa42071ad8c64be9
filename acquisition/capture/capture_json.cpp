#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "acquisition/capture/capture.h"
#include "acquisition/capture/capture_layouts.h"
#include "engine/files/strict_json.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

struct JsonPhotographs {
    std::vector<Photograph> photographs;
    bool exposuresGiven = false;
};

double positiveNumber(const JsonNode& node, const char* expected)
{
    const double number = node.number();
    if (!(number > 0)) {
        throw node.error(fmt::format("is {}", number), expected);
    }
    return number;
}

double secondsOf(const JsonNode& node)
{
    return positiveNumber(node, "a positive time");
}

std::vector<Exposure> bracketOf(const JsonNode& node)
{
    std::vector<Exposure> exposures;
    for (const JsonNode& item : node.items()) {
        item.allowKeys({"file", "seconds"});
        exposures.push_back({item.at("file").existingPath(), secondsOf(item.at("seconds"))});
    }
    if (exposures.empty()) {
        throw node.error("is empty", "at least one exposure");
    }
    return exposures;
}

struct GivenPhotograph {
    Photograph photograph;
    bool exposureGiven;
};

GivenPhotograph readPhotograph(const JsonNode& node, bool lightsAllowed)
{
    if (node.isText()) {
        return {photographOf(node.existingPath()), false};
    }
    if (lightsAllowed) {
        node.allowKeys({"file", "exposureSeconds", "exposures", "light", "skip"});
    } else {
        node.allowKeys({"file", "exposureSeconds", "exposures"});
    }
    const auto skip = node.find("skip");
    if (const auto bracket = node.find("exposures")) {
        if (node.has("file") || node.has("exposureSeconds")) {
            throw node.error("has \"exposures\" beside a file or time of its own", "one of the two");
        }
        Photograph photograph{"", bracketOf(*bracket), skip && skip->truth()};
        photograph.name = photograph.exposures[0].file.filename().string();
        return {photograph, true};
    }
    GivenPhotograph given{photographOf(node.at("file").existingPath()), false};
    given.photograph.skip = skip && skip->truth();
    if (const auto seconds = node.find("exposureSeconds")) {
        given.photograph.exposures[0].seconds = secondsOf(*seconds);
        given.exposureGiven = true;
    }
    return given;
}

// The entries of a "photographs" array: a file's name, an object with "file" and perhaps "exposureSeconds", or one
// with "exposures"; "light" and "skip" are known keys where lights are allowed. Times are given for all or for none.
JsonPhotographs readPhotographs(const std::vector<JsonNode>& nodes, bool lightsAllowed)
{
    JsonPhotographs result;
    for (const JsonNode& node : nodes) {
        const GivenPhotograph given = readPhotograph(node, lightsAllowed);
        if (!result.photographs.empty() && given.exposureGiven != result.exposuresGiven) {
            throw node.error(
                fmt::format("{} an exposure time, unlike the first", given.exposureGiven ? "has" : "lacks"),
                "times for all photographs or for none");
        }
        result.exposuresGiven = given.exposureGiven;
        result.photographs.push_back(given.photograph);
    }
    return result;
}

} // namespace

// Our own layout, docs/formats.md.

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
        lights.vectors.push_back(light->at("direction").vector3());
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

void addNamedIrradiances(LightFile& lights, const JsonNode& node)
{
    if (lights.lights.empty() || lights.irradianceGiven) {
        throw node.error(lights.irradianceGiven ? "comes beside irradiances of the lights" : "comes without directions",
                         "directions from \"lights\" or \"light\", and one source of irradiances");
    }
    addIrradiances(lights, node.existingPath());
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
        addNamedIrradiances(lights, *node);
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

OffsetChoice offsetOf(const JsonNode& node)
{
    if (node.isText() && node.text() == "auto") {
        return {true, 0};
    }
    if (node.isText()) {
        throw node.error(fmt::format("is \"{}\"", node.text()), "a number or \"auto\"");
    }
    const double value = node.number();
    if (!(value >= 0 && value < 1)) {
        throw node.error(fmt::format("is {}", value), "from 0 to below 1, the photographs' full scale");
    }
    return {false, static_cast<float>(value)};
}

Photograph ambientOf(const JsonNode& node, bool exposuresGiven)
{
    const JsonPhotographs read = readPhotographs({node}, false);
    requireAlike(node, read.exposuresGiven, exposuresGiven, "an exposure time");
    return read.photographs[0];
}

// The whole numbers of "crop", in pixels.
void readCrop(const JsonNode& node, FileWindow& window)
{
    const std::vector<double> numbers = node.numbers(4);
    constexpr double kLargest = 1e6;
    for (size_t i = 0; i < 4; ++i) {
        if (numbers[i] != std::floor(numbers[i]) || numbers[i] < (i < 2 ? 0 : 1) || numbers[i] > kLargest) {
            throw node.error(fmt::format("is [{}]", fmt::join(numbers, ", ")),
                             "x, y, width, height in whole pixels, a size of at least 1 x 1");
        }
    }
    window.x = static_cast<int>(numbers[0]);
    window.y = static_cast<int>(numbers[1]);
    window.width = static_cast<int>(numbers[2]);
    window.height = static_cast<int>(numbers[3]);
}

// How many pixels in a row make one.
int boxOf(const JsonNode& node)
{
    const double scale = node.number();
    for (const int box : {1, 2, 3, 4}) {
        if (std::abs(scale * box - 1) < 0.01) { // 0.33 is meant for a third
            return box;
        }
    }
    throw node.error(fmt::format("is {}", scale), "1, 1/2, 1/3 or 1/4: boxes of whole pixels are averaged");
}

void readSizes(const JsonNode& root, LayoutContents& contents)
{
    Capture& capture = contents.capture;
    if (const auto crop = root.find("crop")) {
        readCrop(*crop, capture.window);
    }
    if (const auto scale = root.find("scale")) {
        capture.window.box = boxOf(*scale);
    }
    if (const auto scale = root.find("pixelsPerMillimetre")) {
        capture.pixelsPerMillimetre = positiveNumber(*scale, "a positive number");
    }
    if (root.has("lightDistance") && !root.has("objectWidth")) {
        throw root.error("has \"lightDistance\" alone", "\"objectWidth\" beside it, in one unit of length");
    }
    if (const auto width = root.find("objectWidth")) {
        contents.objectWidth = positiveNumber(*width, "a positive length");
    }
    if (const auto distance = root.find("lightDistance")) {
        capture.lightDistance = positiveNumber(*distance, "a positive length") / *contents.objectWidth;
    }
    if (const auto degrees = root.find("fieldOfView")) {
        capture.fieldOfView = degrees->number();
        if (!(*capture.fieldOfView > 0 && *capture.fieldOfView <= kWidestView)) {
            throw degrees->error(fmt::format("is {}", *capture.fieldOfView),
                                 fmt::format("degrees above 0, {} at most", kWidestView));
        }
    }
}

void readSpheres(const JsonNode& root, Capture& capture)
{
    if (const auto sphere = root.find("mirrorSphere")) {
        capture.mirrorSphere = sphereOf(*sphere);
    }
    if (const auto sphere = root.find("diffuseSphere")) {
        capture.diffuseSphere = sphereOf(*sphere);
    }
}

} // namespace

std::optional<LayoutContents> readJsonLayout(const fs::path& file)
{
    if (!fs::exists(file)) {
        return std::nullopt;
    }
    const JsonNode root = JsonNode::loadVersioned(file, "nacre capture", kCaptureVersion);
    root.allowKeys({"format",       "version",       "name",
                    "transfer",     "mask",          "truthNormals",
                    "lights",       "irradiances",   "photographs",
                    "mirrorSphere", "diffuseSphere", "ambient",
                    "offset",       "crop",          "scale",
                    "labels",       "lightDistance", "objectWidth",
                    "fieldOfView",  "smooth",        "pixelsPerMillimetre"});
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
    const auto fileOf = [&](const char* key) {
        const auto node = root.find(key);
        return node ? node->existingPath() : fs::path();
    };
    if (root.has("mask")) {
        contents.masks = {fileOf("mask")};
    }
    capture.truthNormals = fileOf("truthNormals");
    capture.labelsFile = fileOf("labels");
    capture.smoothFile = fileOf("smooth");
    if (const auto offset = root.find("offset")) {
        contents.offset = offsetOf(*offset);
    }
    if (const auto ambient = root.find("ambient")) {
        capture.ambient = ambientOf(*ambient, read.exposuresGiven);
    }
    readSizes(root, contents);
    readSpheres(root, capture);
    return contents;
}

} // namespace nacre
