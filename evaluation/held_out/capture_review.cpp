#include "evaluation/held_out/capture_review.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "evaluation/held_out/held_out_measures.h"

namespace nacre {

namespace {

constexpr size_t kEvery = 7;
constexpr int kThumbnailSide = 192;              // pixels
constexpr size_t kPeakSamples = size_t{1} << 22; // values of all photographs together

Observations readOne(const Capture& capture, size_t photograph, int threads)
{
    const Capture one = selectPhotographs(capture, {photograph});
    Observations seen;
    ObservationReader(one, threads, ~size_t{0}).next(seen);
    return seen;
}

double sampledPeak(const Capture& capture, int threads)
{
    const size_t step = std::max<size_t>(1, capture.maskPixels * capture.photographs.size() * 3 / kPeakSamples);
    std::vector<glm::vec3> values;
    for (size_t i = 0; i < capture.photographs.size(); ++i) {
        const Observations seen = readOne(capture, i, threads);
        for (size_t p = 0; p < seen.radiance.size(); p += step) {
            values.push_back(seen.radiance[p]);
        }
    }
    return peakOf(values);
}

// Names, lights and what the acquisition has seen of them.
std::vector<ReviewedPhotograph> listPhotographs(const Capture& capture, const AcquireOptions& options,
                                                const NormalEstimate& estimate)
{
    const Rig rig = calibrateLights(capture, options.calibration);
    std::vector<ReviewedPhotograph> photographs;
    for (size_t i = 0; i < capture.photographs.size(); ++i) {
        ReviewedPhotograph& photograph = photographs.emplace_back();
        photograph.name = capture.photographs[i].name;
        photograph.light = rig.lights[i];
        photograph.isDiscordant =
            std::find(estimate.leftOut.begin(), estimate.leftOut.end(), photograph.name) != estimate.leftOut.end();
    }
    for (size_t i = 0; i < estimate.given.size(); ++i) {
        photographs[estimate.given[i]].light = estimate.rig.lights[i]; // as corrected
        photographs[estimate.given[i]].isGiven = true;
    }
    return photographs;
}

// Empty, with the reason in `review`, where nobody needs it or nobody can have it.
std::optional<Acquisition> acquireWithheld(const Capture& capture, AcquireOptions options, const Progress& progress,
                                           CaptureReview& review)
{
    const auto isUnseen = [](const ReviewedPhotograph& p) { return !p.isGiven && !p.isDiscordant; };
    const auto unseen = std::count_if(review.photographs.begin(), review.photographs.end(), isUnseen);
    if (unseen > 0) {
        review.heldOut = fmt::format("{} photographs were not given to this acquisition, and judge it.", unseen);
        return std::nullopt;
    }
    options.lights.heldOutEvery = kEvery;
    options.keepVerdicts = false;
    options.ladder.toleranceDecibels = 0;
    options.ladder.budgetBytes = 0;
    try {
        Acquisition acquisition = acquire(capture, options, progress);
        review.heldOut = fmt::format("A second acquisition with the same options holds every {}th photograph back, and "
                                     "predicts those.",
                                     kEvery);
        return acquisition;
    } catch (const Error& error) {
        review.heldOut = std::string("No photograph could be held back: ") + error.what();
        return std::nullopt;
    }
}

} // namespace

Image thumbnailOf(const Image& picture, const Capture& capture, int side)
{
    int left = picture.width, top = picture.height, right = 0, bottom = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (capture.mask[static_cast<size_t>(y) * picture.width + x]) {
                left = std::min(left, x), right = std::max(right, x + 1);
                top = std::min(top, y), bottom = std::max(bottom, y + 1);
            }
        }
    }
    const int box = std::max(1, (std::max(right - left, bottom - top) + side - 1) / side);
    Image small(std::max(1, (right - left) / box), std::max(1, (bottom - top) / box), 3);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            glm::vec3 sum(0);
            for (int i = 0; i < box * box; ++i) {
                sum += picture.rgb(left + x * box + i % box, top + y * box + i / box);
            }
            small.setRgb(x, y, sum / static_cast<float>(box * box));
        }
    }
    return small;
}

CaptureReview reviewCapture(const Capture& capture, const AcquireOptions& options, const Acquisition& acquisition,
                            const Progress& progress)
{
    const int threads = options.normals.threads;
    CaptureReview review;
    review.photographs = listPhotographs(capture, options, acquisition.estimate);
    const std::optional<Acquisition> withheld = acquireWithheld(capture, options, progress, review);
    progress("report", 0);
    const double peak = sampledPeak(capture, threads);
    for (size_t i = 0; i < review.photographs.size(); ++i) {
        progress("report", static_cast<double>(i) / static_cast<double>(review.photographs.size()));
        ReviewedPhotograph& photograph = review.photographs[i];
        JudgingPhotographs one{readOne(capture, i, threads), {}, peak};
        const auto psnrBy = [&](const Acquisition& judged) {
            one.lights = placedLights(capture, {i}, {photograph.light}, judged.estimate.nearField);
            return psnrOf(judged.surface, one, threads);
        };
        photograph.psnr = psnrBy(acquisition);
        if (withheld && isHeldOutOfEvery(i, kEvery)) {
            photograph.heldOutPsnr = psnrBy(*withheld);
        }
        const Image picture = pictureOf(one.seen, one.seen.radiance, 0, capture.width, capture.height);
        photograph.thumbnail =
            displayedImage(thumbnailOf(picture, capture, kThumbnailSide), {.exposureStops = exposureOfPeak(peak)});
    }
    return review;
}

} // namespace nacre
