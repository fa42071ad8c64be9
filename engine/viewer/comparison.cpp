#include "engine/viewer/comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/surface/normal_map.h"

namespace nacre {

Image fittedPicture(const Image& picture, int width, int height)
{
    const std::vector<int64_t> from = fittedPixels(picture.width, picture.height, width, height);
    Image fitted(width, height, 3);
    for (size_t i = 0; i < from.size(); ++i) {
        for (size_t c = 0; from[i] >= 0 && c < 3; ++c) {
            fitted.values[3 * i + c] = picture.values[3 * static_cast<size_t>(from[i]) + c];
        }
    }
    return fitted;
}

Image comparisonPicture(Comparison comparison, const Image& photograph, const Image& render, const Display& display)
{
    Image picture = displayedImage(photograph, display);
    if (comparison == Comparison::difference) {
        for (size_t i = 0; i < picture.values.size(); ++i) {
            const float difference = 0.5f + kDifferenceGain * (picture.values[i] - render.values[i]);
            picture.values[i] = std::round(255 * std::clamp(difference, 0.0f, 1.0f)) / 255;
        }
    }
    return picture;
}

std::string describeComparison(const Image& photograph, const Frame& render, const Surface& surface, double peak)
{
    std::vector<uint8_t> mask(surface.labels.size());
    double photographed = 0, rendered = 0;
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = surface.labels[i] < surface.materials.size() && surface.normals.confidence[i] > 0;
        for (size_t c = 0; mask[i] && c < 3; ++c) {
            photographed += photograph.values[3 * i + c];
            rendered += render.values[3 * i + c];
        }
    }
    const double ratio = rendered > 0 ? photographed / rendered : 0;
    return fmt::format("PSNR {:.1f} dB of radiance over the object; photograph / render in the mean {:.3f}",
                       radiancePsnr(photograph, render, mask, peak), ratio);
}

} // namespace nacre
