#include "app/materials/library_packing.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/arguments/short_name.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/error.h"
#include "engine/materials/material_specification.h"
#include "engine/surface/surface_material.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kPackedBallSize = 128; // pixels

// The table is the truth that smaller models are judged by.
BakedMaterial bakedMaterial(std::string name, BrdfTable table, Coverage coverage)
{
    auto truth = std::make_shared<const BrdfTable>(table);
    const auto interpolant = [truth](const glm::vec3& unit) {
        return InterpolatedValue{.value = sampleTable(*truth, unit).value, .nearest = 0};
    };
    return {std::move(name), interpolant, {std::move(table), std::move(coverage)}, glm::vec3(1)};
}

BakedMaterial bakedFrom(const std::string& specification, std::string name, const fs::path& fitsFolder,
                        const LadderOptions& options, RadianceScale& scale)
{
    if (auto found = loadSurfaceMaterial(specification)) {
        if (found->scale == RadianceScale::relative) {
            scale = RadianceScale::relative;
        }
        Material& material = found->material;
        return bakedMaterial(std::move(name), std::move(material.table), std::move(material.coverage));
    }
    const BrdfModel model = parseMaterial(specification, fitsFolder).model;
    const BrdfTable* table = tableOf(model);
    const TableDomain whole{kHalfDifference, kHalfPi};
    return bakedMaterial(std::move(name),
                         table ? *table : tabulatedBrdf(model, tableSize(whole), whole, options.threads), {});
}

void placeBall(Surface& surface, int left, int top, uint8_t label)
{
    const NormalMap ball = sphereNormalMap(kPackedBallSize);
    for (int y = 0; y < kPackedBallSize; ++y) {
        for (int x = 0; x < kPackedBallSize; ++x) {
            const size_t from = ball.index(x, y), to = surface.normals.index(left + x, top + y);
            if (ball.confidence[from] > 0) {
                surface.normals.normals[to] = ball.normals[from];
                surface.normals.confidence[to] = ball.confidence[from];
                surface.labels[to] = label;
            }
        }
    }
}

// As square as rows of balls can be.
Surface gridOfBalls(size_t count)
{
    const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
    const int rows = (static_cast<int>(count) + columns - 1) / columns;
    Surface surface;
    surface.normals = NormalMap(columns * kPackedBallSize, rows * kPackedBallSize);
    surface.labels.assign(surface.normals.normals.size(), Surface::kNoMaterial);
    for (int i = 0; i < static_cast<int>(count); ++i) {
        placeBall(surface, i % columns * kPackedBallSize, i / columns * kPackedBallSize, static_cast<uint8_t>(i));
    }
    return surface;
}

} // namespace

PackedLibrary packedLibrary(const std::vector<std::string>& specifications, const fs::path& fitsFolder,
                            const LadderOptions& options)
{
    if (specifications.size() > Surface::kNoMaterial) {
        throw Error("", fmt::format("{} materials are too many for one surface", specifications.size()),
                    fmt::format("at most {}", static_cast<int>(Surface::kNoMaterial)), Error::kUsage);
    }
    PackedLibrary library;
    RadianceScale scale = RadianceScale::absolute;
    const std::vector<std::string> names = shortNames(specifications);
    std::vector<BakedMaterial> baked;
    for (size_t i = 0; i < specifications.size(); ++i) {
        baked.push_back(bakedFrom(specifications[i], names[i], fitsFolder, options, scale));
        library.fullBytes += baked.back().baked.table.values.size() * bytesPerTexel(TexelFormat::rgba32f);
    }
    ReducedMaterials reduced = reduceMaterials(std::move(baked), options);
    library.surface = gridOfBalls(specifications.size());
    library.surface.materials = std::move(reduced.materials);
    library.surface.scale = scale;
    library.ladders = std::move(reduced.ladders);
    library.shared = std::move(reduced.shared);
    return library;
}

} // namespace nacre
