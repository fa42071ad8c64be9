#include "app/report/verdict_pictures.h"

#include <algorithm>
#include <cmath>

#include "app/report/contact_sheet.h"

namespace nacre {

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
