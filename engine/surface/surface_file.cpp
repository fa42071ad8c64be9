// Surfaces as folders: surface.json and the pictures that it names (docs/formats.md).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/parallel_for.h"
#include "engine/files/strict_json.h"
#include "engine/files/whole_file.h"
#include "engine/lights/light_files.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr const char* kSurfaceFormat = "nacre surface";
constexpr int kSurfaceVersion = 1;
// Coverage changes slowly: texels that are kept of it beside a model that is not a table.
constexpr glm::ivec3 kCoverageSize{24, 12, 8};
constexpr int kMostTexels = 512; // a side of a table
constexpr const char* kWeightFile = "residual_weights.exr";

nlohmann::json arrayOf(const glm::vec3& v)
{
    return nlohmann::json::array({v.x, v.y, v.z});
}

// The picture that a key names.
fs::path fileOf(const JsonNode& name)
{
    return name.file().parent_path() / name.text();
}

// A picture of one size whose values are numbers.
Image loadPicture(const fs::path& file, int width, int height, int channels)
{
    Image picture = loadImage(file);
    if (picture.width != width || picture.height != height || picture.channels != channels) {
        throw Error(file, fmt::format("is {}x{} with {} channels", picture.width, picture.height, picture.channels),
                    fmt::format("{}x{} with {}", width, height, channels));
    }
    if (!std::all_of(picture.values.begin(), picture.values.end(), [](float v) { return std::isfinite(v); })) {
        throw Error(file, "has a value that is no number", "finite values");
    }
    return picture;
}

Image loadBeside(const JsonNode& name, const Surface& surface, int channels)
{
    return loadPicture(fileOf(name), surface.normals.width, surface.normals.height, channels);
}

void saveLabels(const fs::path& file, const Surface& surface)
{
    Image image(surface.normals.width, surface.normals.height, 1);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        image.values[i] = surface.labels[i] / 255.0f;
    }
    saveImage(file, image, PixelType::uint8);
}

std::vector<uint8_t> loadLabels(const JsonNode& name, const Surface& surface)
{
    const Image image = loadBeside(name, surface, 1);
    std::vector<uint8_t> labels(image.values.size());
    const bool ofMaterials = !surface.materials.empty() || surface.parts.empty();
    const size_t count = ofMaterials ? surface.materials.size() : surface.parts.size();
    for (size_t i = 0; i < labels.size(); ++i) {
        labels[i] = static_cast<uint8_t>(std::lround(image.values[i] * 255.0f));
        if (labels[i] != Surface::kNoMaterial && labels[i] >= count) {
            throw Error(fileOf(name), fmt::format("names {} {}", ofMaterials ? "material" : "part", labels[i]),
                        fmt::format("indices below {}, or 255 for none", count));
        }
    }
    return labels;
}

nlohmann::json descriptionOf(const Surface& surface)
{
    nlohmann::json json = {{"format", kSurfaceFormat},
                           {"version", kSurfaceVersion},
                           {"scale", surface.scale == RadianceScale::absolute ? "absolute" : "relative"},
                           {"width", surface.normals.width},
                           {"height", surface.normals.height},
                           {"normals", "normals.exr"},
                           {"labels", "labels.png"},
                           {"materials", nlohmann::json::array()},
                           {"lights", nlohmann::json::array()}};
    if (!surface.albedo.values.empty()) {
        json["albedo"] = "albedo.exr";
    }
    if (!surface.height.values.empty()) {
        json["heights"] = "height.exr"; // "height" is the picture's
    }
    if (!surface.transfer.empty()) {
        json["transfer"] = surface.transfer;
    }
    if (surface.camera) {
        json["camera"] = arrayOf(*surface.camera);
    }
    if (surface.castsShadows) {
        json["shadows"] = true;
    }
    if (surface.pixelsPerMillimetre) {
        json["pixelsPerMillimetre"] = *surface.pixelsPerMillimetre;
    }
    if (surface.leftOutDecibels) {
        json["leftOutDecibels"] = *surface.leftOutDecibels;
    }
    if (!surface.parts.empty()) {
        json["parts"] = surface.parts;
    }
    for (const CapturedLight& light : surface.lights) {
        nlohmann::json& written = json["lights"].emplace_back();
        written = {{"photograph", light.photograph},
                   {"direction", arrayOf(light.light.direction)},
                   {"irradiance", arrayOf(light.light.irradiance)}};
        if (std::isfinite(light.light.distance)) {
            written["distance"] = light.light.distance;
        }
    }
    return json;
}

nlohmann::json describeModel(const CompactBrdf& model)
{
    if (const auto* lobe = std::get_if<FittedLobe>(&model)) {
        const AbcModel& m = lobe->model;
        return {{"kind", "lobe"}, {"kD", arrayOf(m.kD)}, {"A", arrayOf(m.A)}, {"B", m.B}, {"C", m.C}, {"ior", m.ior}};
    }
    return {{"kind", "table"}, {"format", nameOf(std::get<SmallTable>(model).format)}};
}

// `covered`: of the full size and domain.
CompactBrdf modelOf(const JsonNode& node, const BrdfTable& covered)
{
    const auto number = [&](const char* key) { return static_cast<float>(node.at(key).number()); };
    const std::string kind = node.at("kind").text();
    if (kind == "lobe") {
        return FittedLobe{{node.at("kD").vector3(), node.at("A").vector3(), number("B"), number("C"), number("ior")}};
    }
    if (kind == "table") {
        return SmallTable{covered, texelFormatFromName(node.at("format").text())};
    }
    throw node.error("is of kind \"" + kind + "\"", "lobe or table; acquire the surface again");
}

glm::ivec3 sizeOf(const JsonNode& node)
{
    const std::vector<JsonNode> sides = node.items();
    if (sides.size() != 3) {
        throw node.error(fmt::format("has {} numbers", sides.size()), "3 numbers");
    }
    return {sides[0].whole(1, kMostTexels), sides[1].whole(1, kMostTexels), sides[2].whole(1, kMostTexels)};
}

// A table and its coverage, or the smaller model that it was reduced to beside its coverage alone.
nlohmann::json saveMaterial(const fs::path& folder, const Material& material, size_t index)
{
    const std::string table = fmt::format("material_{}.exr", index);
    nlohmann::json json = {{"name", material.name}, {"table", table}};
    if (!material.coverage.distance.empty()) {
        json["coverage"] = fmt::format("material_{}_coverage.exr", index);
        saveCoverage(folder / json["coverage"].get<std::string>(), material.table.size, material.coverage);
    }
    if (!material.compact || std::holds_alternative<SmallTable>(*material.compact)) {
        saveBrdfTable(folder / table, material.table);
    } else {
        const glm::ivec3& s = material.table.size;
        saveBrdfTable(folder / table,
                      resampledTable(material.table, glm::min(s, kCoverageSize), material.table.domain));
        json["size"] = nlohmann::json::array({s.x, s.y, s.z});
    }
    if (material.compact) {
        json["model"] = describeModel(*material.compact);
    }
    return json;
}

Material materialOf(const JsonNode& node)
{
    Material material;
    material.name = node.at("name").text();
    material.table = loadBrdfTable(fileOf(node.at("table")));
    if (const auto model = node.find("model")) {
        if (const auto size = node.find("size")) {
            material.table = resampledTable(material.table, sizeOf(*size), material.table.domain);
        }
        material.compact = modelOf(*model, material.table);
        material.table = expandedTable(*material.compact, material.table);
    }
    if (const auto coverage = node.find("coverage")) {
        material.coverage = loadCoverage(fileOf(*coverage), material.table.size);
    }
    return material;
}

std::string componentFile(int component)
{
    return fmt::format("residual_{:02}.png", component);
}

size_t codeIndex(const ResidualLayer& layer, int component, size_t pixel)
{
    const size_t texel = static_cast<size_t>(component / kComponentsPerTexel) * layer.pixelCount() + pixel;
    return texel * kComponentsPerTexel + component % kComponentsPerTexel;
}

// residual_NN.png, one grey picture a component, and residual_weights.exr, a row a component and a column a captured
// light.
nlohmann::json saveResidual(const fs::path& folder, const ResidualLayer& layer)
{
    Image weights(static_cast<int>(layer.nodes.size()), layer.components, 3);
    parallelFor(layer.components, 1, 0, [&](size_t first, size_t) {
        const int k = static_cast<int>(first);
        Image picture(layer.width, layer.height, 1);
        for (size_t i = 0; i < layer.pixelCount(); ++i) {
            picture.values[i] = layer.codes[codeIndex(layer, k, i)] / 255.0f;
        }
        saveImage(folder / componentFile(k), picture, PixelType::uint8);
        for (size_t i = 0; i < layer.nodes.size(); ++i) {
            weights.setRgb(static_cast<int>(i), k, layer.weights[k * layer.nodes.size() + i]);
        }
    });
    saveImage(folder / kWeightFile, weights, PixelType::float32);
    return {{"trust", layer.trust}, {"low", layer.low}, {"high", layer.high}};
}

// Of a description that nobody has checked yet; its nodes are the surface's lights.
ResidualLayer emptyLayer(const JsonNode& node, const Surface& surface)
{
    ResidualLayer layer;
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.trust = static_cast<float>(node.at("trust").number());
    const size_t count = node.at("low").items().size();
    if (count == 0 || count > kMostResidualComponents || !(layer.trust >= 0) || !(layer.trust <= 1) ||
        surface.lights.empty()) {
        throw node.error("is no residual layer that can be",
                         fmt::format("1 to {} components with as many \"low\" and \"high\", a \"trust\" in [0, 1], "
                                     "lights",
                                     kMostResidualComponents));
    }
    layer.low = node.at("low").floats(count);
    layer.high = node.at("high").floats(count);
    layer.components = static_cast<int>(count);
    for (const CapturedLight& light : surface.lights) {
        layer.nodes.push_back(light.light.direction);
    }
    layer.codes.assign(layer.layers() * layer.pixelCount() * kComponentsPerTexel, 0);
    return layer;
}

ResidualLayer residualOf(const JsonNode& node, const Surface& surface)
{
    const fs::path folder = node.file().parent_path();
    ResidualLayer layer = emptyLayer(node, surface);
    const Image weights = loadPicture(folder / kWeightFile, static_cast<int>(layer.nodes.size()), layer.components, 3);
    for (int k = 0; k < layer.components; ++k) {
        const Image picture = loadPicture(folder / componentFile(k), layer.width, layer.height, 1);
        for (size_t i = 0; i < layer.pixelCount(); ++i) {
            layer.codes[codeIndex(layer, k, i)] = static_cast<uint8_t>(std::lround(picture.values[i] * 255.0f));
        }
        for (size_t i = 0; i < layer.nodes.size(); ++i) {
            layer.weights.push_back(weights.rgb(static_cast<int>(i), k));
        }
    }
    return layer;
}

RadianceScale scaleOf(const JsonNode& node)
{
    if (node.text() != "absolute" && node.text() != "relative") {
        throw node.error(fmt::format("is \"{}\"", node.text()), "absolute or relative");
    }
    return node.text() == "absolute" ? RadianceScale::absolute : RadianceScale::relative;
}

Light lightOf(const JsonNode& node)
{
    Light light{node.at("direction").vector3(), node.at("irradiance").vector3()};
    if (const auto distance = node.find("distance")) {
        light.distance = lightDistanceOf(*distance);
    }
    return light;
}

glm::vec3 cameraOf(const JsonNode& node)
{
    const glm::vec3 place = node.vector3();
    if (!(place.z >= kNearestLight)) {
        throw node.error(fmt::format("stands {:g} widths before the object, inside it", place.z),
                         fmt::format("{} widths of the object or more", kNearestLight));
    }
    return place;
}

Surface surfaceOf(const JsonNode& root)
{
    Surface surface;
    surface.scale = scaleOf(root.at("scale"));
    surface.normals = loadNormalMap(fileOf(root.at("normals")));
    for (const JsonNode& material : root.at("materials").items()) {
        surface.materials.push_back(materialOf(material));
    }
    if (const auto parts = root.find("parts")) {
        for (const JsonNode& part : parts->items()) {
            surface.parts.push_back(part.text());
        }
    }
    surface.labels = loadLabels(root.at("labels"), surface);
    if (const auto albedo = root.find("albedo")) {
        surface.albedo = loadBeside(*albedo, surface, 3);
    }
    if (const auto heights = root.find("heights")) {
        surface.height = loadBeside(*heights, surface, 1);
    }
    if (const auto transfer = root.find("transfer")) {
        surface.transfer = transfer->text();
    }
    if (const auto camera = root.find("camera")) {
        surface.camera = cameraOf(*camera);
    }
    if (const auto shadows = root.find("shadows")) {
        surface.castsShadows = shadows->truth();
        if (surface.castsShadows && surface.height.values.empty()) {
            throw shadows->error("is true, but there are no heights to cast any", "\"heights\", or no shadows");
        }
    }
    if (const auto pixels = root.find("pixelsPerMillimetre")) {
        surface.pixelsPerMillimetre = pixels->number();
        if (!(*surface.pixelsPerMillimetre > 0)) {
            throw pixels->error(fmt::format("is {:g}", *surface.pixelsPerMillimetre), "a positive number");
        }
    }
    if (const auto decibels = root.find("leftOutDecibels")) {
        surface.leftOutDecibels = decibels->number();
    }
    for (const JsonNode& light : root.at("lights").items()) {
        surface.lights.push_back({light.at("photograph").text(), lightOf(light)});
    }
    if (const auto residual = root.find("residual")) {
        surface.residual = residualOf(*residual, surface);
    }
    return surface;
}

} // namespace

void saveSurface(const fs::path& folder, const Surface& surface, bool replace)
{
    WholeOutput output(folder, replace);
    const fs::path& to = output.temporary();
    std::error_code error;
    if (!fs::create_directory(to, error)) {
        throw Error(folder, "cannot be made: " + error.message(), "a writable place");
    }
    saveNormalMap(to / "normals.exr", surface.normals);
    saveLabels(to / "labels.png", surface);
    if (!surface.albedo.values.empty()) {
        saveImage(to / "albedo.exr", surface.albedo, PixelType::float32);
    }
    if (!surface.height.values.empty()) {
        saveImage(to / "height.exr", surface.height, PixelType::float32);
    }
    nlohmann::json json = descriptionOf(surface);
    for (size_t i = 0; i < surface.materials.size(); ++i) {
        json["materials"].push_back(saveMaterial(to, surface.materials[i], i));
    }
    if (!surface.residual.empty()) {
        json["residual"] = saveResidual(to, surface.residual);
    }
    writeTextFile(to / kSurfaceDescription, json.dump(2) + "\n");
    output.commit();
}

Surface loadSurface(const fs::path& folder)
{
    const fs::path file = folder / kSurfaceDescription;
    if (!fs::is_directory(folder) || !fs::exists(file)) {
        throw Error(folder, fs::exists(folder) ? "is not a surface" : "is not a surface: there is no such folder",
                    "a folder NAME.nacre that `nacre acquire` or `nacre target` wrote");
    }
    return surfaceOf(JsonNode::loadVersioned(file, kSurfaceFormat, kSurfaceVersion));
}

} // namespace nacre
