#include "engine/viewer/comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/surface/normal_map.h"
#include "engine/viewer/picture_texture.h"

namespace nacre {

namespace {

constexpr float kDifferenceGain = 2; // of codes, around middle grey

// The picture fitted into another size as surfaces are (fittedPixels), 0 outside.
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

// What stands in place of the render: the photograph exposed as the render is, or the difference of both's codes,
// brighter than middle grey where the photograph is.
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

// PSNR of radiance over the pixels that have a material, and the mean of photograph over render there.
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

} // namespace

void PhotographComparison::update(const Session& session, const Photographs* photographs, ViewPictures& pictures)
{
    if (session.comparison == Comparison::none || !session.photograph || !photographs) {
        picture_.reset();
        compared_.reset();
        figures_.clear();
        return;
    }
    const std::pair now(*session.photograph, pictures.renderer().drawnPictures());
    if (compared_ == now && by_ == session.comparison) {
        return;
    }
    const Surface& surface = pictures.scene().main->surface;
    const Image photograph =
        fittedPicture(photographs->picture(*session.photograph), surface.normals.width, surface.normals.height);
    compared_ = now;
    by_ = session.comparison;
    picture_ = uploadPicture(
        context_, comparisonPicture(session.comparison, photograph, pictures.renderer().picture(), pictures.display()));
    figures_ = describeComparison(photograph, pictures.radiance(), surface, photographs->peak());
}

} // namespace nacre
