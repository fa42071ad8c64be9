#include "acquisition/capture/exposure_merge.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>

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

namespace {

// Of the files' pixels; not empty.
FileWindow clippedTo(const ImageHeader& header, const FileWindow& part, const std::filesystem::path& file)
{
    FileWindow clipped = part;
    clipped.x = std::max(part.x, 0);
    clipped.y = std::max(part.y, 0);
    clipped.width = std::min(part.x + part.width, header.width) - clipped.x;
    clipped.height = std::min(part.y + part.height, header.height) - clipped.y;
    if (clipped.width <= 0 || clipped.height <= 0) {
        throw Error(file, fmt::format("is {} x {}", header.width, header.height),
                    fmt::format("a picture that has {}, {}", part.x, part.y));
    }
    return clipped;
}

// Band by band, so that a large file costs what is read of it.
Image readPart(ImageRows& rows, const FileWindow& part, const std::filesystem::path& file)
{
    constexpr int kBand = 32;
    const int channels = rows.channels();
    const size_t rowValues = static_cast<size_t>(rows.header().width) * channels,
                 partValues = static_cast<size_t>(part.width) * channels;
    Image image(part.width, part.height, channels);
    std::vector<float> band(kBand * rowValues);
    for (int y = 0; y < part.height; y += kBand) {
        const int count = std::min(kBand, part.height - y);
        rows.read(part.y + y, part.y + y + count, std::span(band).first(count * rowValues));
        for (int row = 0; row < count; ++row) {
            const auto from = band.begin() + static_cast<std::ptrdiff_t>(row * rowValues + size_t(part.x) * channels);
            const auto bad = std::find_if(from, from + static_cast<std::ptrdiff_t>(partValues),
                                          [](float v) { return !std::isfinite(v); });
            if (bad != from + static_cast<std::ptrdiff_t>(partValues)) {
                throw Error(file,
                            fmt::format("has a value that is no number at pixel {}, {}",
                                        part.x + (bad - from) / channels, part.y + y + row),
                            "finite values");
            }
            std::copy_n(from, partValues, image.values.begin() + static_cast<std::ptrdiff_t>((y + row) * partValues));
        }
    }
    return image;
}

} // namespace

MergedPhotograph loadMerged(const Photograph& photograph, const Capture& capture, const FileWindow& part)
{
    std::vector<Image> pictures;
    std::vector<ExposureScale> scales;
    ImageHeader first;
    FileWindow box;
    for (const Exposure& exposure : photograph.exposures) {
        ImageRows rows(exposure.file, capture.curve);
        const ImageHeader& header = rows.header();
        if (pictures.empty()) {
            first = header;
            box = clippedTo(header, part, exposure.file);
        } else if (header.width != first.width || header.height != first.height) {
            throw Error(exposure.file, fmt::format("is {} x {}", header.width, header.height),
                        fmt::format("{} x {} as the bracket's first exposure", first.width, first.height));
        }
        pictures.push_back(readPart(rows, box, exposure.file));
        scales.push_back(exposureScaleOf(header.pixelType, exposure.seconds));
        scales.back().offset = capture.offset;
    }
    MergedPhotograph merged{box.x, box.y, Image(box.width, box.height, 3),
                            std::vector<uint8_t>(pictures.front().pixelCount(), 0)};
    std::vector<glm::vec3> values(pictures.size());
    for (int y = 0; y < box.height; ++y) {
        for (int x = 0; x < box.width; ++x) {
            for (size_t e = 0; e < pictures.size(); ++e) {
                values[e] = pictures[e].rgb(x, y);
            }
            const MergedPixel pixel = mergeExposures(values, scales);
            merged.radiance.setRgb(x, y, pixel.radiance);
            merged.saturated[static_cast<size_t>(y) * box.width + x] = pixel.saturated ? 1 : 0;
        }
    }
    return merged;
}

} // namespace nacre
