#include "acquisition/capture/merged_photograph.h"

#include <fmt/format.h>

#include "acquisition/capture/exposure_merge.h"
#include "engine/files/error.h"

namespace nacre {

MergedPhotograph loadMerged(const Photograph& photograph, const Capture& capture)
{
    std::vector<Image> pictures;
    std::vector<ExposureScale> scales;
    for (const Exposure& exposure : photograph.exposures) {
        pictures.push_back(loadPhotograph(exposure.file, capture.curve));
        scales.push_back(exposureScaleOf(readImageHeader(exposure.file).pixelType, exposure.seconds));
        scales.back().offset = capture.offset;
        const Image& first = pictures.front();
        const Image& last = pictures.back();
        if (last.width != first.width || last.height != first.height) {
            throw Error(exposure.file, fmt::format("is {} x {}", last.width, last.height),
                        fmt::format("{} x {} as the bracket's first exposure", first.width, first.height));
        }
    }
    const int width = pictures.front().width;
    const int height = pictures.front().height;
    MergedPhotograph merged{Image(width, height, 3), std::vector<uint8_t>(pictures.front().pixelCount(), 0)};
    std::vector<glm::vec3> values(pictures.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (size_t e = 0; e < pictures.size(); ++e) {
                values[e] = pictures[e].rgb(x, y);
            }
            const MergedPixel pixel = mergeExposures(values, scales);
            merged.radiance.setRgb(x, y, pixel.radiance);
            merged.saturated[static_cast<size_t>(y) * width + x] = pixel.saturated ? 1 : 0;
        }
    }
    return merged;
}

} // namespace nacre
