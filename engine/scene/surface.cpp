#include "engine/scene/surface.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/error.h"
#include "engine/scene/json_vector.h"
#include "engine/scene/material_file.h"
#include "engine/scene/whole_file.h"

namespace nacre {
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr int kVersion = 1;

Json describe(const Surface& surface)
{
    Json json = {{"format", "nacre surface"},
                 {"version", kVersion},
                 {"scale", surface.scale == RadianceScale::absolute ? "absolute" : "relative"},
                 {"width", surface.normals.width},
                 {"height", surface.normals.height},
                 {"normals", "normals.exr"},
                 {"labels", "labels.png"},
                 {"materials", Json::array()},
                 {"lights", Json::array()}};
    if (!surface.albedo.values.empty()) {
        json["albedo"] = "albedo.exr";
    }
    for (const CapturedLight& light : surface.lights) {
        json["lights"].push_back({{"photograph", light.photograph},
                                  {"direction", jsonOf(light.light.direction)},
                                  {"irradiance", jsonOf(light.light.irradiance)}});
    }
    return json;
}

void saveLabels(const fs::path& file, const Surface& surface)
{
    Image image(surface.normals.width, surface.normals.height, 1);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        image.values[i] = surface.labels[i] / 255.0f;
    }
    saveImage(file, image, PixelType::uint8);
}

std::vector<uint8_t> loadLabels(const fs::path& file, const Surface& surface)
{
    const Image image = loadImage(file);
    if (image.width != surface.normals.width || image.height != surface.normals.height || image.channels != 1) {
        throw Error(file, fmt::format("is {}x{} with {} channels", image.width, image.height, image.channels),
                    fmt::format("{}x{} with 1, as normals.exr", surface.normals.width, surface.normals.height));
    }
    std::vector<uint8_t> labels(image.values.size());
    for (size_t i = 0; i < labels.size(); ++i) {
        labels[i] = static_cast<uint8_t>(image.values[i] * 255.0f + 0.5f);
        if (labels[i] != Surface::kNoMaterial && labels[i] >= surface.materials.size()) {
            throw Error(file, fmt::format("names material {}", labels[i]),
                        fmt::format("indices below {}, or 255 for none", surface.materials.size()));
        }
    }
    return labels;
}

void checkHeader(const fs::path& file, const Json& json)
{
    if (json.value("format", "") != "nacre surface") {
        throw Error(file, "is not a surface", "\"format\": \"nacre surface\"");
    }
    if (json.value("version", 0) != kVersion) {
        throw Error(file, fmt::format("has version {}", json.value("version", 0)), fmt::format("version {}", kVersion));
    }
}

Surface surfaceOf(const fs::path& folder, const Json& json)
{
    Surface surface;
    surface.scale = json.at("scale") == "absolute" ? RadianceScale::absolute : RadianceScale::relative;
    surface.normals = loadNormalMap(folder / json.at("normals").get<std::string>());
    MaterialFolder materials(folder);
    for (const Json& material : json.at("materials")) {
        surface.materials.push_back(materials.load(material));
    }
    surface.labels = loadLabels(folder / json.at("labels").get<std::string>(), surface);
    if (json.contains("albedo")) {
        surface.albedo = loadImage(folder / json.at("albedo").get<std::string>());
        if (surface.albedo.width != surface.normals.width || surface.albedo.height != surface.normals.height ||
            surface.albedo.channels != 3) {
            throw Error(folder / "albedo.exr", "has another shape than the normals", "RGB of the same size");
        }
    }
    for (const Json& light : json.at("lights")) {
        surface.lights.push_back({light.at("photograph").get<std::string>(),
                                  Light{vec3Of(light.at("direction")), vec3Of(light.at("irradiance"))}});
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
    Json json = describe(surface);
    MaterialFolder materials(to);
    for (size_t i = 0; i < surface.materials.size(); ++i) {
        json["materials"].push_back(materials.save(surface.materials[i], i));
    }
    writeTextFile(to / "surface.json", json.dump(2) + "\n");
    output.commit();
}

Surface loadSurface(const fs::path& folder)
{
    const fs::path file = folder / "surface.json";
    if (!fs::is_directory(folder) || !fs::exists(file)) {
        throw Error(folder, "is not a surface", "a folder NAME.nacre that `nacre acquire` wrote");
    }
    try {
        const Json json = Json::parse(readTextFile(file));
        checkHeader(file, json);
        return surfaceOf(folder, json);
    } catch (const Json::exception& e) {
        throw Error(file, std::string("is not understood: ") + e.what(), "the form of docs/formats.md");
    }
}

Surface transferredSurface(const NormalMap& normals, const Material& material)
{
    Surface surface;
    surface.normals = normals;
    surface.materials = {material};
    surface.labels.assign(normals.normals.size(), Surface::kNoMaterial);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (normals.confidence[i] > 0) {
            surface.labels[i] = 0;
        }
    }
    return surface;
}

Surface fittedSurface(const Surface& surface, int width, int height)
{
    Surface fitted = surface;
    fitted.normals = fittedNormalMap(surface.normals, width, height);
    fitted.labels.assign(fitted.normals.normals.size(), Surface::kNoMaterial);
    const bool hasAlbedo = !surface.albedo.values.empty();
    fitted.albedo = hasAlbedo ? Image(width, height, 3, 1.0f) : Image();
    const std::vector<int64_t> from = fittedPixels(surface.normals.width, surface.normals.height, width, height);
    for (size_t i = 0; i < from.size(); ++i) {
        if (from[i] < 0) {
            continue;
        }
        fitted.labels[i] = surface.labels[from[i]];
        if (hasAlbedo) {
            std::copy_n(&surface.albedo.values[3 * from[i]], 3, &fitted.albedo.values[3 * i]);
        }
    }
    return fitted;
}

} // namespace nacre
