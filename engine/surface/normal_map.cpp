#include "engine/surface/normal_map.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/measures.h"
#include "engine/files/text_files.h"

namespace nacre {

namespace {

// Normals shorter than this in n = 2 v - 1 are no normals but a flat background.
constexpr float kShortestNormal = 0.5f;
// A normal map's lengths are about 1, but for 8-bit codes and filtering; a photograph's are anything.
constexpr float kRounding = 1e-6f; // of a unit vector's length
constexpr float kUnitTolerance = 0.1f;
constexpr float kLeastUnitShare = 0.5f;

// The sphere seen from afar; its rim passes through the centres of the border pixels, and what lies beyond is on it.
glm::vec3 normalOfSphere(int x, int y, int size)
{
    const float last = static_cast<float>(size - 1);
    glm::vec2 disc(2 * x / last - 1, 1 - 2 * y / last);
    disc /= std::max(1.0f, glm::length(disc));
    return glm::normalize(glm::vec3(disc, std::sqrt(std::max(0.0f, 1 - glm::dot(disc, disc)))));
}

bool isFloat(const ImageHeader& header)
{
    return header.pixelType == "float" || header.pixelType == "half" || header.pixelType == "double";
}

// Two-channel maps leave z to be told from x and y.
bool holdsNoBlue(const Image& image)
{
    bool isAny = false;
    for (size_t i = 0; i < image.values.size(); i += image.channels) {
        isAny = isAny || image.values[i] > 0 || image.values[i + 1] > 0;
        if (image.values[i + 2] > 0) {
            return false;
        }
    }
    return isAny;
}

} // namespace

NormalMap loadNormalMap(const std::filesystem::path& file, NormalY normalY)
{
    const ImageHeader header = readImageHeader(file);
    const Image image = loadImage(file);
    if (image.channels < 3) {
        throw Error(file, fmt::format("has {} channel(s)", image.channels), "a normal map with x, y and z");
    }
    const bool coded = !isFloat(header);
    NormalMap map(image.width, image.height);
    const bool isTwoChannels = coded && holdsNoBlue(image);
    size_t found = 0, unit = 0, away = 0;
    for (size_t i = 0; i < map.normals.size(); ++i) {
        const float* p = &image.values[i * image.channels];
        const glm::vec3 stored(p[0], p[1], p[2]);
        if (!std::isfinite(stored.x + stored.y + stored.z)) {
            throw Error(file,
                        fmt::format("has a value that is no number at pixel {}, {}", i % image.width, i / image.width),
                        "finite normals");
        }
        const bool black = stored == glm::vec3(0);
        glm::vec3 n = coded ? 2.0f * stored - 1.0f : stored;
        if (normalY == NormalY::dx) {
            n.y = -n.y;
        }
        if (isTwoChannels) {
            n.z = std::sqrt(std::max(0.0f, 1 - n.x * n.x - n.y * n.y));
        }
        const float confidence = image.channels > 3 && !coded ? p[3] : 1.0f;
        const float size = glm::length(n);
        if (black || size < kShortestNormal || confidence <= 0) {
            continue;
        }
        map.normals[i] = !coded && std::abs(size - 1) < kRounding ? n : n / size; // what was saved is what is loaded
        map.confidence[i] = std::min(confidence, 1.0f);
        ++found;
        unit += std::abs(size - 1) < kUnitTolerance;
        away += n.z < 0;
    }
    if (found == 0) {
        throw Error(file, "holds no normal", "a normal map: float x, y, z or integers n = 2 v - 1, black = no data");
    }
    if (static_cast<float>(unit) < kLeastUnitShare * static_cast<float>(found)) {
        throw Error(file,
                    fmt::format("is no normal map: {} has a length of about 1 in {:.0f} % of its pixels",
                                coded ? "2 v - 1" : "x, y, z", 100.0 * static_cast<double>(unit) / found),
                    "unit normals: float x, y, z or integers n = 2 v - 1");
    }
    if (2 * away > found) {
        throw Error(file,
                    fmt::format("faces away in {:.0f} % of its pixels", 100.0 * static_cast<double>(away) / found),
                    "normals towards the viewer: z, in blue, above 0");
    }
    return map;
}

void saveNormalMap(const std::filesystem::path& file, const NormalMap& map)
{
    const bool coded = lowerExtension(file) != ".exr";
    Image image(map.width, map.height, coded ? 3 : 4);
    for (size_t i = 0; i < map.normals.size(); ++i) {
        if (map.confidence[i] <= 0) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            image.values[i * image.channels + c] = coded ? 0.5f + 0.5f * map.normals[i][c] : map.normals[i][c];
        }
        if (!coded) {
            image.values[i * 4 + 3] = map.confidence[i];
        }
    }
    saveImage(file, image, coded ? PixelType::uint16 : PixelType::float32);
}

std::vector<int64_t> fittedPixels(int fromWidth, int fromHeight, int width, int height)
{
    std::vector<int64_t> pixels(static_cast<size_t>(width) * height, -1);
    const float scale = std::min(static_cast<float>(width) / fromWidth, static_cast<float>(height) / fromHeight);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float sx = (x + 0.5f - 0.5f * width) / scale + 0.5f * fromWidth;
            const float sy = (y + 0.5f - 0.5f * height) / scale + 0.5f * fromHeight;
            if (sx >= 0 && sy >= 0 && sx < fromWidth && sy < fromHeight) {
                pixels[static_cast<size_t>(y) * width + x] =
                    static_cast<int64_t>(sy) * fromWidth + static_cast<int64_t>(sx);
            }
        }
    }
    return pixels;
}

NormalMap fittedNormalMap(const NormalMap& map, int width, int height)
{
    NormalMap fitted(width, height);
    const std::vector<int64_t> from = fittedPixels(map.width, map.height, width, height);
    for (size_t i = 0; i < from.size(); ++i) {
        if (from[i] >= 0) {
            fitted.normals[i] = map.normals[from[i]];
            fitted.confidence[i] = map.confidence[from[i]];
        }
    }
    return fitted;
}

NormalMap sphereNormalMap(int size)
{
    NormalMap map(size, size);
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const glm::vec2 disc(2 * (x + 0.5f) / size - 1, 1 - 2 * (y + 0.5f) / size);
            if (glm::length(disc) < 1) {
                map.normals[map.index(x, y)] = normalOfSphere(x, y, size);
                map.confidence[map.index(x, y)] = 1;
            }
        }
    }
    return map;
}

AngularError angularError(const NormalMap& normals, const NormalMap& truth, std::span<const uint8_t> mask)
{
    assert(normals.width == truth.width && normals.height == truth.height && mask.size() == normals.normals.size());
    AngularError result;
    std::vector<float> errors;
    double sum = 0;
    for (size_t i = 0; i < mask.size(); ++i) {
        if (!mask[i] || truth.confidence[i] <= 0) {
            continue;
        }
        const bool found = normals.confidence[i] > 0;
        const double degrees = found ? degreesBetween(normals.normals[i], truth.normals[i]) : 90;
        result.missing += !found;
        sum += degrees;
        errors.push_back(static_cast<float>(degrees));
    }
    result.pixels = errors.size();
    if (!errors.empty()) {
        result.mean = sum / static_cast<double>(errors.size());
        result.median = quantile(errors, 0.5);
        result.percentile95 = quantile(errors, 0.95);
    }
    return result;
}

} // namespace nacre
