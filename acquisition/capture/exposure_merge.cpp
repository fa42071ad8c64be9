#include "acquisition/capture/exposure_merge.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/error.h"

namespace nacre {

namespace {

// Of full scale. Sensors lose linearity just below it, and demosaicing spreads clipped neighbours into a pixel; in a
// bracket another exposure is there to do without.
constexpr float kBracketClipLevel = 0.98f;

// Of black pixels, relative to well exposed ones: small, since there noise and black level prevail, but not 0, so that
// a pixel that is black in all exposures has a mean.
constexpr float kBlackWeight = 1e-3f;

// 0 at the clip level and above, flat in the middle, small near 0: the broad hat of Reinhard et al., High Dynamic
// Range Imaging, 2nd edition, 2010, section 5.7, stretched to the clip level.
float hatWeight(float value, const ExposureScale& scale)
{
    if (!scale.isInteger()) {
        return 1;
    }
    if (value >= kBracketClipLevel) {
        return 0;
    }
    const float centred = 2 * value / kBracketClipLevel - 1;
    const float squared = centred * centred;
    const float fourth = squared * squared;
    return std::max(kBlackWeight, 1 - fourth * fourth * fourth);
}

size_t shortest(std::span<const ExposureScale> scales)
{
    const auto found =
        std::min_element(scales.begin(), scales.end(),
                         [](const ExposureScale& a, const ExposureScale& b) { return a.seconds < b.seconds; });
    return found - scales.begin();
}

MergedPixel single(const glm::vec3& value, const ExposureScale& scale)
{
    const float brightest = std::max({value.x, value.y, value.z});
    // Half a code, so that rounding in the decoder hides no clipped pixel.
    return {(value - scale.offset) / scale.seconds, scale.isInteger() && brightest >= 1 - 0.5f / scale.fullScale};
}

} // namespace

ExposureScale exposureScaleOf(std::string_view pixelType, double seconds)
{
    ExposureScale scale{static_cast<float>(seconds), 0, 0};
    const bool isSigned = pixelType.starts_with("int");
    if (isSigned || pixelType.starts_with("uint")) {
        int bits = 32; // what "int" and "uint" mean
        const std::string_view digits = pixelType.substr(isSigned ? 3 : 4);
        std::from_chars(digits.data(), digits.data() + digits.size(), bits);
        scale.fullScale = std::exp2(static_cast<float>(isSigned ? bits - 1 : bits)) - 1;
    }
    return scale;
}

MergedPixel mergeExposures(std::span<const glm::vec3> values, std::span<const ExposureScale> scales)
{
    if (values.size() == 1) {
        return single(values[0], scales[0]);
    }
    MergedPixel merged{glm::vec3(0), false};
    for (int c = 0; c < 3; ++c) {
        float weights = 0;
        for (size_t e = 0; e < values.size(); ++e) {
            const float weight = scales[e].seconds * hatWeight(values[e][c], scales[e]);
            merged.radiance[c] += weight * ((values[e][c] - scales[e].offset) / scales[e].seconds);
            weights += weight;
        }
        if (weights > 0) {
            merged.radiance[c] /= weights;
        } else {
            const size_t e = shortest(scales);
            merged.radiance[c] = (values[e][c] - scales[e].offset) / scales[e].seconds;
            merged.saturated = true;
        }
    }
    return merged;
}

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
