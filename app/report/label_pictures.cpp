#include "app/report/label_pictures.h"

#include "engine/files/image.h"
#include "shared/false_colour.h"

namespace nacre {

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

} // namespace nacre
