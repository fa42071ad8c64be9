#include "acquisition/segmentation/segment_options.h"

#include <optional>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/files/text_files.h"

namespace nacre {

namespace {

size_t countOf(const std::string& text)
{
    const std::optional<double> number = parseNumber(text);
    const bool whole = number && *number >= 1 && *number <= kMostMaterials && *number == static_cast<int>(*number);
    if (!whole) {
        throw Error("", fmt::format("--segment auto:{} is not possible", text),
                    fmt::format("auto:N with N from 1 to {}", kMostMaterials), Error::kUsage);
    }
    return static_cast<size_t>(*number);
}

} // namespace

SegmentOptions segmentOptionsFrom(const std::string& text)
{
    if (text.empty()) {
        return {};
    }
    if (text == "none") {
        return {SegmentSource::none, {}, 0};
    }
    if (text == "auto") {
        return {SegmentSource::found, {}, 0};
    }
    if (text.starts_with("auto:")) {
        const size_t count = countOf(text.substr(5));
        return count == 1 ? SegmentOptions{SegmentSource::none, {}, 0}
                          : SegmentOptions{SegmentSource::found, {}, count};
    }
    return {SegmentSource::picture, text, 0};
}

} // namespace nacre
