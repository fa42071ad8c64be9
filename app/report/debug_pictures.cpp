#include "app/report/debug_pictures.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"
#include "engine/scene/ball.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kDebugBallSize = 256;
constexpr int kMagnification = 4; // table texels are small

// Three slices below each other, magnified; `pick` answers a texel's colour.
template <class Pick> Image sliceSheet(const BrdfTable& table, Pick&& pick)
{
    const int slices[] = {0, table.size.z / 2, table.size.z - 1};
    Image sheet(table.size.x * kMagnification, table.size.y * kMagnification * 3, 3);
    for (int y = 0; y < sheet.height; ++y) {
        for (int x = 0; x < sheet.width; ++x) {
            const int row = y / kMagnification;
            sheet.setRgb(x, y, pick(table.index(x / kMagnification, row % table.size.y, slices[row / table.size.y])));
        }
    }
    return sheet;
}

void savePicturesOf(const BrdfTable& table, const fs::path& folder, const std::string& suffix)
{
    const Image brdf = sliceSheet(table, [&](size_t texel) { return table.values[texel]; });
    saveImage(folder / ("brdf" + suffix), displayedImage(brdf, {.exposureStops = automaticExposure(brdf)}),
              PixelType::uint8);
    const Image coverage = sliceSheet(table, [&](size_t texel) { return glm::vec3(table.confidence[texel]); });
    saveImage(folder / ("brdf_coverage" + suffix), coverage, PixelType::uint8);
    saveImage(folder / ("ball" + suffix), ballPicture(table), PixelType::uint8);
}

} // namespace

Image ballPicture(const BrdfTable& table)
{
    const Light light{glm::normalize(glm::vec3(-0.4f, 0.5f, 0.77f))};
    const Image ball = materialBall(std::make_shared<const BrdfTable>(table), {&light, 1}, kDebugBallSize);
    return displayedImage(ball, {.exposureStops = automaticExposure(ball)});
}

void makeDebugFolder(const fs::path& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder)) {
        throw Error(folder, "cannot be made: " + error.message(), "a folder for pictures");
    }
}

void saveNormalPictures(const fs::path& folder, const NormalMap& normals)
{
    saveNormalMap(folder / "normals.png", normals);
    Image confidence(normals.width, normals.height, 1);
    std::copy(normals.confidence.begin(), normals.confidence.end(), confidence.values.begin());
    saveImage(folder / "confidence.png", confidence, PixelType::uint8);
}

void saveMaterialPictures(const fs::path& folder, const std::vector<Material>& materials)
{
    for (size_t i = 0; i < materials.size(); ++i) {
        savePicturesOf(materials[i].table, folder, materials.size() > 1 ? fmt::format("-{}.png", i + 1) : ".png");
    }
}

} // namespace nacre
