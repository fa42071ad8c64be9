#include "engine/gpu/surface_textures.h"

#include <algorithm>

#include <glm/common.hpp>

#include "engine/scene/coverage.h"
#include "shared/ball.h"

namespace nacre {
namespace {

std::vector<glm::vec4> normalTexels(const Surface& surface, bool plain)
{
    const NormalMap& map = surface.normals;
    std::vector<glm::vec4> texels(map.normals.size(), glm::vec4(0));
    for (size_t i = 0; i < texels.size(); ++i) {
        if (map.confidence[i] > 0 && (!plain || surface.labels[i] == 0)) {
            texels[i] = glm::vec4(map.normals[i], map.confidence[i]);
        }
    }
    return texels;
}

VkRect2D boundsOfData(std::span<const glm::vec4> normals, int width)
{
    glm::ivec2 low(width, static_cast<int>(normals.size()) / std::max(width, 1)), high(0);
    for (size_t i = 0; i < normals.size(); ++i) {
        if (normals[i].w > 0) {
            const glm::ivec2 pixel(static_cast<int>(i) % width, static_cast<int>(i) / width);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel + 1);
        }
    }
    const glm::uvec2 size(glm::max(high - low, glm::ivec2(0)));
    return {.offset = {low.x, low.y}, .extent = {size.x, size.y}};
}

// In place: x, y as shaders/shared/ball.h packs them.
void pack(std::vector<glm::vec4>& normals)
{
    for (glm::vec4& n : normals) {
        n = n.w > 0 ? glm::vec4(packedFromNormal(glm::vec3(n)), 0, 0) : glm::vec4(1, 1, 0, 0);
    }
}

std::vector<glm::vec4> albedoTexels(const Surface& surface)
{
    const std::vector<float>& albedo = surface.albedo.values;
    std::vector<glm::vec4> texels(surface.labels.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        const auto label = static_cast<float>(surface.labels[i]);
        texels[i] = albedo.empty() ? glm::vec4(1, 1, 1, label)
                                   : glm::vec4(albedo[3 * i], albedo[3 * i + 1], albedo[3 * i + 2], label);
    }
    return texels;
}

std::vector<glm::vec4> placeTexels(const Surface& surface)
{
    std::vector<glm::vec4> texels;
    for (const glm::vec3& place : surface.places) {
        texels.emplace_back(place, 0);
    }
    return texels;
}

// The layer's texels lie picture by picture; the shader fetches all of a pixel's, which is quickest from one place.
TexelBuffer uploadResidual(const Context& context, const ResidualLayer& layer)
{
    return uploadTexels(context, kIntegersFormat, layer.codes.size(), [&](uint8_t* to) {
        for (size_t pixel = 0; pixel < layer.pixelCount(); ++pixel) {
            for (size_t i = 0; i < layer.layers(); ++i, to += kComponentsPerTexel) {
                std::copy_n(&layer.codes[(i * layer.pixelCount() + pixel) * kComponentsPerTexel], kComponentsPerTexel,
                            to);
            }
        }
    });
}

} // namespace

bool isPlain(const Surface& surface)
{
    return surface.materials.size() == 1 && surface.albedo.values.empty();
}

PixelTextures uploadPixels(const Context& context, const Surface& surface, bool plain, Precision precision)
{
    const VkExtent3D extent{static_cast<uint32_t>(surface.normals.width), static_cast<uint32_t>(surface.normals.height),
                            1};
    const bool full = precision == Precision::full;
    std::vector<glm::vec4> normals = normalTexels(surface, plain);
    PixelTextures textures;
    textures.shown = boundsOfData(normals, surface.normals.width);
    if (!full) {
        pack(normals);
    }
    textures.normals =
        uploadTexture(context, VK_IMAGE_TYPE_2D, extent, full ? kFloatFormat : kPackedNormalFormat, normals);
    if (!plain) {
        textures.albedo =
            uploadTexture(context, VK_IMAGE_TYPE_2D, extent, full ? kFloatFormat : kHalfFormat, albedoTexels(surface));
    }
    if (!surface.horizon.empty()) {
        textures.horizon =
            uploadLayers(context, extent, static_cast<uint32_t>(surface.horizon.azimuths), surface.horizon.codes);
    }
    if (!surface.places.empty()) {
        textures.places =
            uploadTexture(context, VK_IMAGE_TYPE_2D, extent, full ? kFloatFormat : kHalfFormat, placeTexels(surface));
    }
    if (!surface.residual.empty()) {
        textures.residual = uploadResidual(context, surface.residual);
        textures.residualFours = (surface.residual.components + 3) / 4;
    }
    return textures;
}

TableTexture uploadTable(const Context& context, const BrdfTable& table)
{
    std::vector<glm::vec4> texels(table.values.size());
    for (size_t i = 0; i < texels.size(); ++i) {
        texels[i] = glm::vec4(table.values[i], expectedError(table, i));
    }
    const glm::uvec3 size(table.size);
    return {uploadTexture(context, VK_IMAGE_TYPE_3D, {size.x, size.y, size.z}, kFloatFormat, texels), table.domain,
            knowsCoverage(table)};
}

} // namespace nacre
