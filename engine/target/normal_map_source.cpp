#include "engine/target/normal_map_source.h"

#include <cmath>

#include <fmt/format.h>

#include "engine/target/normal_map_scale.h"

namespace nacre {
namespace {

// JPEG and 8-bit rounding are white noise, which halving the picture averages away; shapes stay. Beyond 4 pixels
// smoothed normals of fine relief are no longer those of a height.
constexpr int kScales = 3;
// Fewer cells may agree by chance.
constexpr size_t kFewestCells = 1000;
// Steeper normals have slopes that say more about rounding than about shape.
constexpr float kLeastSlopeZ = 0.2f;
// One residual has to be below this share of the other. Wool, sails, own targets and camera-space maps have 0.02 to
// 0.4, atlases of statues 0.4 to 0.5; noise and cylinders 1.
constexpr double kTelling = 0.75;

struct Residuals {
    double asIs = 0; // sums of absolute values over cells
    double flipped = 0;
    size_t cells = 0;
};

// Around the cells between four neighbouring pixels.
Residuals residualsOf(const NormalMap& map)
{
    Residuals sum;
    for (int y = 0; y + 1 < map.height; ++y) {
        for (int x = 0; x + 1 < map.width; ++x) {
            const size_t i = map.index(x, y), corners[] = {i, i + 1, i + map.width, i + map.width + 1};
            glm::vec2 slope[4];
            bool known = true;
            for (int k = 0; k < 4; ++k) {
                const glm::vec3& n = map.normals[corners[k]];
                known = known && map.confidence[corners[k]] > 0 && n.z >= kLeastSlopeZ;
                slope[k] = slopeOfNormal(n, kLeastSlopeZ);
            }
            if (known) {
                const float pUp = 0.5f * (slope[0].x + slope[1].x - slope[2].x - slope[3].x);
                const float qRight = 0.5f * (slope[1].y + slope[3].y - slope[0].y - slope[2].y);
                sum.asIs += std::abs(pUp - qRight);
                sum.flipped += std::abs(pUp + qRight);
                ++sum.cells;
            }
        }
    }
    return sum;
}

void integrate(IntegratedSurface& result)
{
    IntegratedHeight integrated = heightFromNormals(result.surface.normals);
    result.surface.height = std::move(integrated.height);
    result.pieces = integrated.pieces;
}

} // namespace

Integrability checkIntegrability(const NormalMap& map)
{
    Integrability result;
    NormalMap smaller;
    double largestContrast = 0;
    for (int scale = 0; scale < kScales; ++scale) {
        smaller = scale == 0 ? map : halvedNormalMap(smaller);
        const Residuals residuals = residualsOf(smaller);
        if (residuals.cells < kFewestCells || residuals.asIs + residuals.flipped == 0) {
            continue;
        }
        const double contrast = std::abs(residuals.asIs - residuals.flipped) / (residuals.asIs + residuals.flipped);
        if (contrast > largestContrast) {
            largestContrast = contrast;
            result.residualRatio = residuals.flipped > 0 ? residuals.asIs / residuals.flipped : HUGE_VAL;
        }
    }
    if (result.residualRatio < kTelling) {
        result.verdict = GreenVerdict::agrees;
    } else if (result.residualRatio > 1 / kTelling) {
        result.verdict = GreenVerdict::flipped;
    }
    return result;
}

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
