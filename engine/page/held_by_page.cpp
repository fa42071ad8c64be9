#include "engine/page/held_by_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/scene/coverage.h"
#include "engine/surface/object_places.h"
#include "shared/ball.h"

namespace nacre {
namespace {

constexpr float kMostHeld = 65504; // the largest half float
constexpr float kMostCode = 65535;

bool isHeld(const glm::vec3& f)
{
    return std::isfinite(f.x + f.y + f.z) && std::max({f.x, f.y, f.z}) <= kMostHeld;
}

uint16_t codeOf(float steps)
{
    return static_cast<uint16_t>(std::lround(std::clamp(steps, 0.0f, kMostCode)));
}

} // namespace

glm::u16vec2 normalCode(const glm::vec3& normal)
{
    return glm::u16vec2(glm::round(kNormalSteps * (packedFromNormal(normal) + 1.0f)));
}

glm::vec3 normalFromCode(const glm::u16vec2& code)
{
    return glm::normalize(normalFromDisc(kPackedReach * (glm::vec2(code) / kNormalSteps - 1.0f)));
}

float albedoStep(const Surface& surface)
{
    float largest = 0;
    for (const float factor : surface.albedo.values) {
        largest = std::max(largest, std::min(factor, kMostHeld));
    }
    return std::max(1.0f / 512, std::sqrt(largest) / kMostCode);
}

uint16_t albedoCode(float factor, float step)
{
    return codeOf(std::sqrt(std::clamp(factor, 0.0f, kMostHeld)) / step);
}

float albedoFromCode(uint16_t code, float step)
{
    const float root = step * static_cast<float>(code);
    return root * root;
}

uint16_t HeightCodes::of(float height) const
{
    return codeOf((height - low) / step);
}

HeightCodes heightCodes(const Surface& surface)
{
    constexpr float kFinest = 1.0f / 256;
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (size_t i = 0; i < surface.height.values.size(); ++i) {
        if (surface.normals.confidence[i] > 0) {
            low = std::min(low, surface.height.values[i]);
            high = std::max(high, surface.height.values[i]);
        }
    }
    return low > high ? HeightCodes{0, kFinest} : HeightCodes{low, std::max(kFinest, (high - low) / kMostCode)};
}

void requireHeld(const Material& material)
{
    for (const glm::vec3& f : material.table.values) {
        if (!isHeld(f)) {
            throw Error("",
                        fmt::format("material {} has values that are not finite or above {}", material.name, kMostHeld),
                        "reflectance that half floats, which a page has, can hold");
        }
    }
}

Material heldByPage(Material material)
{
    BrdfTable& table = material.table;
    if (std::max({table.size.x, table.size.y, table.size.z}) > kMostTexelsAlong) {
        throw Error(
            "",
            fmt::format("material {} has a table of {}x{}x{}", material.name, table.size.x, table.size.y, table.size.z),
            fmt::format("at most {} texels a side, as a page can hold them", kMostTexelsAlong));
    }
    requireHeld(material);
    const bool isTold = knowsCoverage(table);
    std::vector<float> error;
    for (size_t i = 0; i < table.values.size(); ++i) {
        if (isTold) {
            error.push_back(throughHalf(expectedError(table, i)));
        }
        table.values[i] = quantised(table.values[i], TexelFormat::rgba16f);
    }
    table.error = std::move(error);
    return material;
}

Surface heldByPage(Surface surface)
{
    for (size_t i = 0; i < surface.normals.normals.size(); ++i) {
        if (surface.normals.confidence[i] > 0) {
            surface.normals.normals[i] = normalFromCode(normalCode(surface.normals.normals[i]));
        }
    }
    const float step = albedoStep(surface);
    for (float& factor : surface.albedo.values) {
        factor = albedoFromCode(albedoCode(factor, step), step);
    }
    if (!surface.height.values.empty()) {
        const HeightCodes codes = heightCodes(surface);
        for (size_t i = 0; i < surface.height.values.size(); ++i) {
            float& height = surface.height.values[i];
            height = surface.normals.confidence[i] > 0 ? codes.height(codes.of(height)) : height;
        }
    }
    if (!surface.horizon.empty()) {
        surface.horizon = horizonMap(surface.normals, heightInPicture(surface), surface.horizon.azimuths);
    }
    for (Material& material : surface.materials) {
        material = heldByPage(std::move(material));
    }
    return surface;
}

} // namespace nacre
