#include "engine/surface/residual_file.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

constexpr const char* kWeights = "residual_weights.exr";

std::string componentName(int component)
{
    return fmt::format("residual_{:02}.png", component);
}

size_t codeIndex(const ResidualLayer& layer, int component, size_t pixel)
{
    const size_t texel = static_cast<size_t>(component / kComponentsPerTexel) * layer.pixelCount() + pixel;
    return texel * kComponentsPerTexel + component % kComponentsPerTexel;
}

Image componentPicture(const ResidualLayer& layer, int component)
{
    Image picture(layer.width, layer.height, 1);
    for (size_t i = 0; i < layer.pixelCount(); ++i) {
        picture.values[i] = layer.codes[codeIndex(layer, component, i)] / 255.0f;
    }
    return picture;
}

Image weightPicture(const ResidualLayer& layer)
{
    Image picture(static_cast<int>(layer.terms()), layer.components, 3);
    for (int k = 0; k < layer.components; ++k) {
        for (size_t i = 0; i < layer.terms(); ++i) {
            picture.setRgb(static_cast<int>(i), k, layer.weights[k * layer.terms() + i]);
        }
    }
    return picture;
}

Image loadChecked(const fs::path& file, int width, int height, int channels)
{
    Image picture = loadImage(file);
    if (picture.width != width || picture.height != height || picture.channels != channels) {
        throw Error(file, fmt::format("is {}x{} with {} channels", picture.width, picture.height, picture.channels),
                    fmt::format("{}x{} with {}", width, height, channels));
    }
    for (const float value : picture.values) {
        if (!std::isfinite(value)) {
            throw Error(file, "has a value that is no number", "finite values");
        }
    }
    return picture;
}

// Of a description that nobody has checked yet.
ResidualLayer emptyLayer(const fs::path& folder, const Json& json, const Surface& surface)
{
    ResidualLayer layer;
    layer.width = surface.normals.width;
    layer.height = surface.normals.height;
    layer.trust = json.at("trust").get<float>();
    layer.low = json.at("low").get<std::vector<float>>();
    layer.high = json.at("high").get<std::vector<float>>();
    const size_t count = layer.low.size();
    if (count == 0 || count > kMostResidualComponents || layer.high.size() != count || !(layer.trust >= 0) ||
        !(layer.trust <= 1) || surface.lights.empty()) {
        throw Error(folder / "surface.json", "describes no residual layer that can be",
                    fmt::format("1 to {} components with as many \"low\" and \"high\", a \"trust\" in [0, 1], lights",
                                kMostResidualComponents));
    }
    layer.components = static_cast<int>(count);
    for (const CapturedLight& light : surface.lights) {
        layer.nodes.push_back(lightPlanePoint(light.light.direction));
    }
    layer.codes.assign(layer.layers() * layer.pixelCount() * kComponentsPerTexel, 0);
    return layer;
}

} // namespace

Json saveResidual(const fs::path& folder, const ResidualLayer& layer)
{
    for (int k = 0; k < layer.components; ++k) {
        saveImage(folder / componentName(k), componentPicture(layer, k), PixelType::uint8);
    }
    saveImage(folder / kWeights, weightPicture(layer), PixelType::float32);
    return {{"trust", layer.trust}, {"low", layer.low}, {"high", layer.high}};
}

ResidualLayer loadResidual(const fs::path& folder, const Json& json, const Surface& surface)
{
    ResidualLayer layer = emptyLayer(folder, json, surface);
    for (int k = 0; k < layer.components; ++k) {
        const Image picture = loadChecked(folder / componentName(k), layer.width, layer.height, 1);
        for (size_t i = 0; i < layer.pixelCount(); ++i) {
            layer.codes[codeIndex(layer, k, i)] = static_cast<uint8_t>(picture.values[i] * 255.0f + 0.5f);
        }
    }
    const Image weights = loadChecked(folder / kWeights, static_cast<int>(layer.terms()), layer.components, 3);
    for (int k = 0; k < layer.components; ++k) {
        for (size_t i = 0; i < layer.terms(); ++i) {
            layer.weights.push_back(weights.rgb(static_cast<int>(i), k));
        }
    }
    return layer;
}

} // namespace nacre
