#include "engine/target/normal_map_source.h"

#include <fmt/format.h>

namespace nacre {
namespace {

void integrate(IntegratedSurface& result)
{
    IntegratedHeight integrated = heightFromNormals(result.surface.normals);
    result.surface.height = std::move(integrated.height);
    result.pieces = integrated.pieces;
}

} // namespace

IntegratedSurface surfaceOfNormals(const NormalMap& normals)
{
    IntegratedSurface result;
    result.surface.normals = normals;
    result.surface.parts = {"surface"};
    result.surface.labels.assign(normals.normals.size(), Surface::kNoMaterial);
    for (size_t i = 0; i < normals.normals.size(); ++i) {
        if (normals.confidence[i] > 0) {
            result.surface.labels[i] = 0;
        }
    }
    integrate(result);
    return result;
}

IntegratedSurface surfaceWithoutMaterials(Surface acquired)
{
    IntegratedSurface result;
    result.surface.normals = std::move(acquired.normals);
    result.surface.labels = std::move(acquired.labels);
    result.surface.parts = std::move(acquired.parts);
    if (result.surface.parts.empty()) {
        for (const Material& material : acquired.materials) {
            result.surface.parts.push_back(material.name);
        }
    }
    if (acquired.height.values.empty()) {
        integrate(result);
    } else {
        result.surface.height = std::move(acquired.height);
    }
    return result;
}

std::string flippedGreenWarning(const std::filesystem::path& file, const NormalMap& map, NormalY normalY)
{
    const Integrability check = checkIntegrability(map);
    if (check.verdict != GreenVerdict::flipped) {
        return {};
    }
    return fmt::format(
        "{}: its green seems to point {}: as a surface, these normals contradict each other {:.2g} times as "
        "much as with green flipped",
        file.string(), normalY == NormalY::gl ? "down" : "up", check.residualRatio);
}

} // namespace nacre
