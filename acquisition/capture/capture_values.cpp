// How the numbers in the files relate to radiance: sizes, transfer curve, exposure times, offset.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/exposure_merge.h"
#include "acquisition/capture/observations.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Exposure times that differ by less are one: EXIF rounds them.
constexpr double kSameTime = 1e-3;

struct ReadHeader {
    Exposure* exposure;
    ImageHeader header;
};

std::vector<ReadHeader> readHeaders(std::vector<Photograph>& photographs)
{
    std::vector<ReadHeader> headers;
    for (Photograph& photograph : photographs) {
        for (Exposure& exposure : photograph.exposures) {
            headers.push_back({&exposure, readImageHeader(exposure.file)});
        }
    }
    return headers;
}

void requireOneSize(std::span<const ReadHeader> headers)
{
    const ImageHeader& first = headers[0].header;
    for (const auto& [exposure, header] : headers) {
        if (header.width != first.width || header.height != first.height) {
            throw Error(
                exposure->file, fmt::format("is {} x {}", header.width, header.height),
                fmt::format("{} x {} as {}", first.width, first.height, headers[0].exposure->file.filename().string()));
        }
    }
}

// The camera stood still, whatever its sensor of gravity said: pixels of one place have to stay in one place. Files of
// another format may have been turned upright.
void requireOneOrientation(std::span<const ReadHeader> headers)
{
    for (const ReadHeader& read : headers) {
        const auto first = std::find_if(headers.begin(), headers.end(), [&](const ReadHeader& other) {
            return other.header.format == read.header.format;
        });
        if (read.header.orientation != first->header.orientation) {
            throw Error(read.exposure->file,
                        fmt::format("is turned by its EXIF orientation {}, {} by {}", read.header.orientation,
                                    first->exposure->file.filename().string(), first->header.orientation),
                        "one orientation in all files, as of one still camera (exiftool -n -Orientation=1 FILES)");
        }
    }
}

std::string describeCurve(const ImageHeader& header)
{
    if (!header.curveIsDeclared) {
        return "declares no transfer curve";
    }
    return "declares " + (header.curve == TransferCurve::linear ? "linear values" : header.curve.name);
}

// Of spheres, those that declare nothing follow the object's.
void takeDeclaredCurve(Capture& capture, std::span<const ReadHeader> headers)
{
    const ImageHeader& first = headers[0].header;
    const std::string firstName = headers[0].exposure->file.filename().string();
    for (const auto& [exposure, header] : headers) {
        if (!(header.curve == first.curve) && (header.curveIsDeclared || first.curveIsDeclared)) {
            throw Error(exposure->file,
                        fmt::format("{}, while {} {}", describeCurve(header), firstName, describeCurve(first)),
                        "one curve for all photographs, declared or chosen (--transfer)");
        }
    }
    capture.curve = first.curve;
    capture.curveIsAssumed = !first.curveIsDeclared && first.pixelType == "uint8";
    capture.curveSource = first.curveIsDeclared ? "declared by " + firstName : "assumed: the files declare none";
    if (!first.otherColours.empty()) {
        capture.curveSource += "; " + first.otherColours;
    }
}

// Exposure times from EXIF, where they differ, relative to the first photograph's.
void takeExifTimes(std::span<const ReadHeader> headers)
{
    std::optional<double> reference;
    const ReadHeader* differing = nullptr;
    const ReadHeader* lacking = nullptr;
    for (const ReadHeader& read : headers) {
        const std::optional<double> seconds = read.header.exposureSeconds;
        if (!seconds) {
            lacking = lacking ? lacking : &read;
            continue;
        }
        reference = reference.value_or(*seconds);
        if (std::abs(*seconds / *reference - 1) > kSameTime) {
            differing = differing ? differing : &read;
        }
    }
    if (!differing) {
        return;
    }
    if (lacking) {
        throw Error(lacking->exposure->file,
                    fmt::format("has no exposure time, while {} has {} s of its own",
                                differing->exposure->file.filename().string(), *differing->header.exposureSeconds),
                    "EXIF exposure times in all photographs, or a capture.json that gives them");
    }
    for (const ReadHeader& read : headers) {
        read.exposure->seconds = *read.header.exposureSeconds / *reference;
    }
}

// Exif 2.32 (CIPA DC-008, 2019), FocalLengthIn35mmFilm: the picture's diagonal stands for that of film, 36 x 24 mm.
double viewOnFilm(const ImageHeader& header)
{
    const double share = header.width / std::hypot(header.width, header.height);
    return glm::degrees(2 * std::atan(share * std::hypot(36, 24) / 2 / *header.filmFocalLength));
}

// None where the photographs state none, or several.
std::optional<double> viewByExif(std::span<const ReadHeader> headers)
{
    const std::optional<double> focalLength = headers[0].header.filmFocalLength;
    const bool isOne = std::all_of(headers.begin(), headers.end(),
                                   [&](const ReadHeader& read) { return read.header.filmFocalLength == focalLength; });
    return focalLength && isOne ? std::optional(viewOnFilm(headers[0].header)) : std::nullopt;
}

} // namespace

void examineHeaders(LayoutContents& contents, const std::optional<TransferCurve>& chosen)
{
    Capture& capture = contents.capture;
    std::vector<ReadHeader> all = readHeaders(capture.photographs);
    if (capture.ambient) {
        for (Exposure& exposure : capture.ambient->exposures) {
            all.push_back({&exposure, readImageHeader(exposure.file)});
        }
    }
    requireOneOrientation(all);
    requireOneSize(all);
    capture.viewByExif = viewByExif(all);
    fitWindow(capture, all[0].header.width, all[0].header.height, contents.listing);
    for (auto* sphere : {&capture.mirrorSphere, &capture.diffuseSphere}) {
        if (*sphere) {
            const std::vector<ReadHeader> headers = readHeaders((*sphere)->photographs);
            requireOneSize(headers);
            all.insert(all.end(), headers.begin(), headers.end());
        }
    }
    requireOneOrientation(all);
    if (chosen) {
        capture.curve = *chosen;
        capture.curveSource = "chosen";
    } else if (contents.transfer) {
        capture.curve = *contents.transfer;
        capture.curveSource = contents.listing.filename().string();
    } else {
        takeDeclaredCurve(capture, all);
    }
    if (!contents.exposuresGiven) {
        takeExifTimes(all);
    }
}

namespace {

struct OffsetEstimate {
    float value = 0;    // 0 where the photographs show none
    std::string reason; // for the user
};

// Quantiles over the pixels of their least values. The lowest is above single dead pixels, the highest still among
// shadows where an object has them over a tenth of its pixels.
constexpr double kLow = 0.01;
constexpr double kMiddle = 0.05;
constexpr double kHigh = 0.1;
// The high and the low one agree: their difference is a small share of the offset itself.
constexpr float kLargestSpread = 0.25f;
// Of the brightest values: less is within what noise and rounding leave in a shadow.
constexpr float kLeastOffsetShare = 0.01f;

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

// The constant that every value carries (black level, stray light), where shadows show it: a pixel's least value over
// all photographs is the offset where any of them leaves it in shadow, so that the low quantiles of these least values
// agree, while without an offset or without shadows they spread down to 0. Reads every photograph once.
OffsetEstimate estimateOffset(const Capture& capture)
{
    std::vector<float> least;
    std::vector<float> greatest;
    ObservationReader reader(withPlainExposures(capture));
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
    if (!(middle > kLeastOffsetShare * bright)) {
        return {0, "none: " + measured + ", black against the brightest"};
    }
    if (high - low > kLargestSpread * middle) {
        return {0, "none: " + measured + ", which do not agree"};
    }
    return {low, "estimated: " + measured};
}

} // namespace

void applyOffset(Capture& capture, const OffsetChoice& choice)
{
    if (!choice.automatic) {
        capture.offset = choice.value;
        capture.offsetSource = choice.value > 0 ? "given" : "";
        return;
    }
    const OffsetEstimate estimate = estimateOffset(capture);
    capture.offset = estimate.value;
    capture.offsetSource = estimate.reason;
}

} // namespace nacre
