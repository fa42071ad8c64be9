#include "engine/target/height_map.h"

#include <charconv>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"

namespace nacre {
namespace {

// Rise over run along one axis from the neighbours before and behind; NaN = no such neighbour.
float difference(float before, float here, float behind)
{
    const bool hasBefore = std::isfinite(before), hasBehind = std::isfinite(behind);
    if (hasBefore && hasBehind) {
        return 0.5f * (behind - before);
    }
    return hasBehind ? behind - here : hasBefore ? here - before : 0.0f;
}

float heightAt(const Image& height, int x, int y)
{
    const bool inside = x >= 0 && y >= 0 && x < height.width && y < height.height;
    return inside ? height.at(x, y) : std::numeric_limits<float>::quiet_NaN();
}

glm::vec3 normalAt(const Image& height, int x, int y)
{
    const float here = height.at(x, y);
    const float right = difference(heightAt(height, x - 1, y), here, heightAt(height, x + 1, y));
    const float up = difference(heightAt(height, x, y + 1), here, heightAt(height, x, y - 1));
    return glm::normalize(glm::vec3(-right, -up, 1));
}

} // namespace

Surface surfaceOfHeight(const Image& height)
{
    Surface surface;
    surface.normals = NormalMap(height.width, height.height);
    surface.labels.assign(height.pixelCount(), Surface::kNoMaterial);
    surface.parts = {"surface"};
    surface.height = Image(height.width, height.height, 1);
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            const size_t i = surface.normals.index(x, y);
            if (std::isfinite(height.values[i])) {
                surface.normals.normals[i] = normalAt(height, x, y);
                surface.normals.confidence[i] = 1;
                surface.labels[i] = 0;
                surface.height.values[i] = height.values[i];
            }
        }
    }
    return surface;
}

HeightScale heightScaleFromArgument(const std::string& text)
{
    HeightScale scale;
    const char* end = text.data() + text.size();
    const auto number = std::from_chars(text.data(), end, scale.value);
    const std::string_view unit(number.ptr, static_cast<size_t>(end - number.ptr));
    if (number.ec != std::errc() || !std::isfinite(scale.value) || scale.value == 0 ||
        (unit != "" && unit != "px" && unit != "%")) {
        throw Error(
            "", fmt::format("height scale {} is not understood", text),
            "pixels between black and white (40 or 40px; negative = black is high) or a share of the width (5%)",
            Error::kUsage);
    }
    scale.ofWidth = unit == "%";
    scale.value /= scale.ofWidth ? 100.0f : 1.0f;
    return scale;
}

bool isGrey(const Image& image)
{
    if (image.channels < 3) {
        return true;
    }
    for (size_t i = 0; i < image.values.size(); i += image.channels) {
        if (image.values[i] != image.values[i + 1] || image.values[i] != image.values[i + 2]) {
            return false;
        }
    }
    return true;
}

HeightMap loadHeightMap(const std::filesystem::path& file, const std::optional<HeightScale>& scale)
{
    const ImageHeader header = readImageHeader(file);
    const Image image = loadImage(file);
    if (!isGrey(image)) {
        throw Error(file, "is in colour", "a height map: one channel, or three alike");
    }
    HeightMap map;
    const bool coded = header.pixelType.starts_with("uint");
    const HeightScale fallback = coded ? HeightScale{kDefaultHeightOfWidth, true} : HeightScale{1, false};
    map.scale = scale.value_or(fallback).pixels(image.width);
    map.eightBit = header.pixelType == "uint8";
    map.height = Image(image.width, image.height, 1);
    size_t known = 0;
    for (size_t i = 0; i < map.height.values.size(); ++i) {
        map.height.values[i] = map.scale * image.values[i * image.channels];
        known += std::isfinite(map.height.values[i]);
    }
    if (known == 0) {
        throw Error(file, "holds no height", "at least one finite value");
    }
    return map;
}

} // namespace nacre
