#include "engine/surface/surface.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/json_vector.h"
#include "engine/files/whole_file.h"
#include "engine/surface/material_file.h"
#include "engine/surface/residual_file.h"

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
    if (!surface.height.values.empty()) {
        json["heights"] = "height.exr"; // "height" is the picture's
    }
    if (!surface.parts.empty()) {
        json["parts"] = surface.parts;
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
    const bool ofMaterials = !surface.materials.empty() || surface.parts.empty();
    const size_t count = ofMaterials ? surface.materials.size() : surface.parts.size();
    for (size_t i = 0; i < labels.size(); ++i) {
        labels[i] = static_cast<uint8_t>(image.values[i] * 255.0f + 0.5f);
        if (labels[i] != Surface::kNoMaterial && labels[i] >= count) {
            throw Error(file, fmt::format("names {} {}", ofMaterials ? "material" : "part", labels[i]),
                        fmt::format("indices below {}, or 255 for none", count));
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

// A picture beside surface.json that has the normals' size.
Image loadBeside(const fs::path& folder, const Json& name, const Surface& surface, int channels)
{
    const fs::path file = folder / name.get<std::string>();
    Image image = loadImage(file);
    const NormalMap& normals = surface.normals;
    if (image.width != normals.width || image.height != normals.height || image.channels != channels) {
        throw Error(file, "has another shape than the normals",
                    fmt::format("{}x{} with {} channel(s)", normals.width, normals.height, channels));
    }
    return image;
}

Image loadHeights(const fs::path& folder, const Json& name, const Surface& surface)
{
    Image height = loadBeside(folder, name, surface, 1);
    if (!std::all_of(height.values.begin(), height.values.end(), [](float z) { return std::isfinite(z); })) {
        throw Error(folder / name.get<std::string>(), "has a value that is no number", "finite heights in pixels");
    }
    return height;
}

Surface surfaceOf(const fs::path& folder, const Json& json)
{
    Surface surface;
    surface.scale = json.at("scale") == "absolute" ? RadianceScale::absolute : RadianceScale::relative;
    surface.normals = loadNormalMap(folder / json.at("normals").get<std::string>());
    for (const Json& material : json.at("materials")) {
        surface.materials.push_back(loadMaterialFiles(folder, material));
    }
    if (json.contains("parts")) {
        surface.parts = json.at("parts").get<std::vector<std::string>>();
    }
    surface.labels = loadLabels(folder / json.at("labels").get<std::string>(), surface);
    if (json.contains("albedo")) {
        surface.albedo = loadBeside(folder, json.at("albedo"), surface, 3);
    }
    if (json.contains("heights")) {
        surface.height = loadHeights(folder, json.at("heights"), surface);
    }
    for (const Json& light : json.at("lights")) {
        surface.lights.push_back({light.at("photograph").get<std::string>(),
                                  Light{vec3Of(light.at("direction")), vec3Of(light.at("irradiance"))}});
    }
    if (json.contains("residual")) {
        surface.residual = loadResidual(folder, json.at("residual"), surface);
    }
    return surface;
}

} // namespace

size_t bytesOf(const Material& material)
{
    return material.compact ? bytesOf(*material.compact)
                            : material.table.values.size() * bytesPerTexel(TexelFormat::rgba32f);
}

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
    Json json = describe(surface);
    for (size_t i = 0; i < surface.materials.size(); ++i) {
        json["materials"].push_back(saveMaterialFiles(to, surface.materials[i], i));
    }
    if (!surface.residual.empty()) {
        json["residual"] = saveResidual(to, surface.residual);
    }
    writeTextFile(to / "surface.json", json.dump(2) + "\n");
    output.commit();
}

Surface loadSurface(const fs::path& folder)
{
    const fs::path file = folder / "surface.json";
    if (!fs::is_directory(folder) || !fs::exists(file)) {
        throw Error(folder, "is not a surface", "a folder NAME.nacre that `nacre acquire` or `nacre target` wrote");
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

Surface transferredSurface(const Surface& target, const Material& material)
{
    Surface surface = transferredSurface(target.normals, material);
    surface.height = target.height;
    surface.horizon = target.horizon;
    return surface;
}

Surface fittedSurface(const Surface& surface, int width, int height)
{
    Surface fitted = surface;
    fitted.normals = fittedNormalMap(surface.normals, width, height);
    fitted.labels.assign(fitted.normals.normals.size(), Surface::kNoMaterial);
    const bool hasAlbedo = !surface.albedo.values.empty();
    fitted.albedo = hasAlbedo ? Image(width, height, 3, 1.0f) : Image();
    const bool hasHeight = !surface.height.values.empty();
    fitted.height = hasHeight ? Image(width, height, 1) : Image();
    // Heights are in pixels, which shrink and grow with the picture.
    const float scale = std::min(static_cast<float>(width) / static_cast<float>(surface.normals.width),
                                 static_cast<float>(height) / static_cast<float>(surface.normals.height));
    const std::vector<int64_t> from = fittedPixels(surface.normals.width, surface.normals.height, width, height);
    fitted.horizon = pickedHorizon(surface.horizon, from, width, height);
    fitted.residual = pickedResidual(surface.residual, from, width, height);
    for (size_t i = 0; i < from.size(); ++i) {
        if (from[i] < 0) {
            continue;
        }
        fitted.labels[i] = surface.labels[from[i]];
        if (hasHeight) {
            fitted.height.values[i] = scale * surface.height.values[from[i]];
        }
        if (hasAlbedo) {
            std::copy_n(&surface.albedo.values[3 * from[i]], 3, &fitted.albedo.values[3 * i]);
        }
    }
    return fitted;
}

} // namespace nacre
