#include <cmath>
#include <span>

#include <fmt/format.h>

#include "acquisition/capture/capture_layouts.h"
#include "acquisition/capture/capture_window.h"
#include "engine/files/error.h"

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

const char* describeCurve(const ImageHeader& header)
{
    if (!header.curveIsDeclared) {
        return "declares no transfer curve";
    }
    return header.declaredCurve == TransferCurve::srgb ? "declares sRGB" : "declares linear values";
}

// A header that declares nothing stands for linear values.
void takeDeclaredCurve(Capture& capture, std::span<const ReadHeader> headers)
{
    const ImageHeader& first = headers[0].header;
    const std::string firstName = headers[0].exposure->file.filename().string();
    for (const auto& [exposure, header] : headers) {
        if (header.declaredCurve != first.declaredCurve) {
            throw Error(exposure->file,
                        fmt::format("{}, while {} {}", describeCurve(header), firstName, describeCurve(first)),
                        "one curve for all photographs; --transfer settles it");
        }
    }
    capture.curve = first.declaredCurve;
    capture.curveSource = first.curveIsDeclared ? "declared by " + firstName : "assumed";
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
    requireOneSize(all);
    fitWindow(capture, all[0].header.width, all[0].header.height, contents.listing);
    for (auto* sphere : {&capture.mirrorSphere, &capture.diffuseSphere}) {
        if (*sphere) {
            const std::vector<ReadHeader> headers = readHeaders((*sphere)->photographs);
            requireOneSize(headers);
            all.insert(all.end(), headers.begin(), headers.end());
        }
    }
    if (chosen) {
        capture.curve = *chosen;
        capture.curveSource = "--transfer";
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

} // namespace nacre
