#include "app/materials/export_albedo.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "shared/glsl.h"

namespace nacre {

Image exportedAlbedo(const Surface& surface)
{
    const glm::vec3 normal(0, 0, 1), light = glm::normalize(glm::vec3(1, 0, 1));
    std::vector<glm::vec3> reflectances;
    for (const Material& material : surface.materials) {
        reflectances.push_back(kPi * evaluateTable(material.table, normal, light, normal).value);
    }
    Image albedo(surface.normals.width, surface.normals.height, 3);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (surface.labels[i] >= reflectances.size() || surface.normals.confidence[i] <= 0) {
            continue;
        }
        for (int c = 0; c < 3; ++c) {
            const float factor = surface.albedo.values.empty() ? 1 : surface.albedo.values[3 * i + c];
            albedo.values[3 * i + c] = factor * reflectances[surface.labels[i]][c];
        }
    }
    return albedo;
}

float saveAlbedo(const std::filesystem::path& file, const Image& albedo)
{
    if (file.extension() == ".exr") {
        saveImage(file, albedo, PixelType::float32);
        return 1;
    }
    const float largest = *std::max_element(albedo.values.begin(), albedo.values.end());
    const float scale = largest > 1 ? std::exp2(std::ceil(std::log2(largest))) : 1;
    Image coded = albedo;
    for (float& value : coded.values) {
        value /= scale;
    }
    saveImage(file, coded, PixelType::uint16, {{"nacre:albedoScale", fmt::format("{}", scale)}});
    return scale;
}

} // namespace nacre
