#include "app/label_pictures.h"

#include <cmath>

#include "engine/scene/image.h"

namespace nacre {

namespace {

// Hues a golden section apart, so that the first few differ well whatever their number.
glm::vec3 colourOf(size_t material)
{
    const float hue = std::fmod(0.08f + 0.618034f * static_cast<float>(material), 1.0f);
    const auto channel = [&](float shift) {
        const float t = std::fabs(std::fmod(hue + shift, 1.0f) * 6 - 3) - 1;
        return 0.25f + 0.75f * std::fmin(1.0f, std::fmax(0.0f, t));
    };
    return {channel(0), channel(2.0f / 3), channel(1.0f / 3)};
}

} // namespace

void saveLabelPicture(const std::filesystem::path& folder, const Segmentation& segmentation, int width, int height)
{
    constexpr float kBorderShade = 0.45f;
    Image picture(width, height, 3);
    for (size_t i = 0; i < segmentation.labels.size(); ++i) {
        if (segmentation.labels[i] != kUnlabelled) {
            const glm::vec3 colour = colourOf(segmentation.labels[i]);
            picture.setRgb(static_cast<int>(i % width), static_cast<int>(i / width),
                           segmentation.inner[i] ? colour : kBorderShade * colour);
        }
    }
    saveImage(folder / "labels.png", picture, PixelType::uint8);
}

} // namespace nacre
