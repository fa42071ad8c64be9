#include "app/report/debug_pictures.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/report/contact_sheet.h"
#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/scene/ball.h"
#include "shared/false_colour.h"

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

void saveLabelPicture(const std::filesystem::path& folder, const Segmentation& segmentation, int width, int height)
{
    constexpr float kBorderShade = 0.45f;
    Image picture(width, height, 3);
    for (size_t i = 0; i < segmentation.labels.size(); ++i) {
        if (segmentation.labels[i] != kUnlabelled) {
            const glm::vec3 colour = labelColour(segmentation.labels[i]);
            picture.setRgb(static_cast<int>(i % width), static_cast<int>(i / width),
                           segmentation.inner[i] ? colour : kBorderShade * colour);
        }
    }
    saveImage(folder / "labels.png", picture, PixelType::uint8);
}

namespace {

constexpr int kCellSize = 160; // pixels

glm::vec3 colourOf(Verdict verdict)
{
    switch (verdict) {
    case Verdict::used:
        return {0.9f, 0.9f, 0.9f};
    case Verdict::shadow:
        return {0.15f, 0.3f, 0.75f};
    case Verdict::highlight:
        return {0.95f, 0.8f, 0.1f};
    case Verdict::saturated:
        break;
    }
    return {0.9f, 0.1f, 0.1f};
}

Image verdictsUnder(size_t light, const Capture& capture, const NormalEstimate& estimate, int step)
{
    const size_t lights = estimate.rig.lights.size();
    Image picture((capture.width + step - 1) / step, (capture.height + step - 1) / step, 3);
    for (size_t p = 0; p < estimate.pixels.size(); ++p) {
        const int x = static_cast<int>(estimate.pixels[p] % capture.width),
                  y = static_cast<int>(estimate.pixels[p] / capture.width);
        if (x % step == 0 && y % step == 0) {
            picture.setRgb(x / step, y / step, colourOf(estimate.everyVerdict[p * lights + light]));
        }
    }
    return picture;
}

} // namespace

void saveVerdictPictures(const std::filesystem::path& folder, const Capture& capture, const NormalEstimate& estimate)
{
    const size_t lights = estimate.rig.lights.size();
    const int step = std::max(1, (std::max(capture.width, capture.height) + kCellSize - 1) / kCellSize);
    const size_t columns = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(lights))));
    std::vector<std::vector<SheetCell>> rows;
    for (size_t i = 0; i < lights; ++i) {
        if (i % columns == 0) {
            rows.emplace_back();
        }
        rows.back().push_back({verdictsUnder(i, capture, estimate, step), capture.photographs[i].name});
    }
    saveImage(folder / "verdicts.png", contactSheet(rows, kCellSize, kCellSize), PixelType::uint8);
}

} // namespace nacre
