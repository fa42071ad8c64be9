#include "acquisition/capture/capture_offset.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "acquisition/capture/observations.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Quantiles over the pixels of their least values. The lowest is above single dead pixels, the highest still among
// shadows where an object has them over a tenth of its pixels.
constexpr double kLow = 0.01;
constexpr double kMiddle = 0.05;
constexpr double kHigh = 0.1;
// The high and the low one agree: their difference is a small share of the offset itself.
constexpr float kLargestSpread = 0.25f;
// Of the brightest values: less is within what noise and rounding leave in a shadow.
constexpr float kLeastShare = 0.01f;

// Every exposure a photograph of its own, without times and offset: values as the files have them.
Capture withPlainExposures(const Capture& capture)
{
    Capture plain = capture;
    plain.offset = 0;
    plain.ambient.reset();
    plain.photographs.clear();
    for (const Photograph& photograph : capture.photographs) {
        for (const Exposure& exposure : photograph.exposures) {
            plain.photographs.push_back({photograph.name, {{exposure.file, 1.0}}});
        }
    }
    return plain;
}

} // namespace

OffsetEstimate estimateOffset(const Capture& capture, int threads)
{
    std::vector<float> least;
    std::vector<float> greatest;
    ObservationReader reader(withPlainExposures(capture), threads);
    for (Observations block; reader.next(block);) {
        for (size_t p = 0; p < block.pixels.size(); ++p) {
            float low = std::numeric_limits<float>::infinity();
            float high = -low;
            for (const glm::vec3& value : block.radianceOf(p)) {
                low = std::min(low, channelMean(value));
                high = std::max(high, channelMean(value));
            }
            least.push_back(low);
            greatest.push_back(high);
        }
    }
    const float low = quantile(least, kLow);
    const float middle = quantile(least, kMiddle);
    const float high = quantile(least, kHigh);
    const float bright = quantile(greatest, 0.99);
    const std::string measured = fmt::format("the least values of 1, 5 and 10 % of the pixels are below {:.4f}, {:.4f} "
                                             "and {:.4f}",
                                             low, middle, high);
    if (!(middle > kLeastShare * bright)) {
        return {0, "none: " + measured + ", black against the brightest"};
    }
    if (high - low > kLargestSpread * middle) {
        return {0, "none: " + measured + ", which do not agree"};
    }
    return {low, "estimated: " + measured};
}

} // namespace nacre
