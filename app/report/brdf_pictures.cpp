#include "app/report/brdf_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/report/contact_sheet.h"
#include "engine/brdf/brdf_comparison.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"
#include "engine/scene/ball.h"

namespace nacre {
namespace {

constexpr const char* kPictures[] = {"slices.png", "sphere.png"};
constexpr int kSliceSize = 270; // pixels: three a degree of thetaD
constexpr int kBrdfBallSize = 270;
constexpr float kBrighterStops = 3;
constexpr float kDecades = 4; // that a slice shows below its peak
constexpr float kHorizonGrey = 0.25f;
constexpr glm::vec3 kAxis(0, 0, 1);

// The rectangle of coordinates that a slice shows.
HalfDifference coordinatesOf(int x, int y, float phiD)
{
    HalfDifference c = halfDifferenceFromUnit({x / (kSliceSize - 1.0f), y / (kSliceSize - 1.0f), 0}, kHalfPi);
    c.phiD = phiD;
    return c;
}

bool isBelowHorizon(const HalfDifference& c)
{
    const LightView d = directionsFromHalfDifference(c);
    return d.l.z <= 0 || d.v.z <= 0;
}

glm::vec3 logarithmic(const glm::vec3& f, float peak)
{
    glm::vec3 display;
    for (int c = 0; c < 3; ++c) {
        display[c] = f[c] > 0 ? std::clamp(1 + std::log10(f[c] / peak) / kDecades, 0.0f, 1.0f) : 0.0f;
    }
    return display;
}

Image slicePicture(const BrdfModel& model, float phiD, float peak, int threads)
{
    Image picture(kSliceSize, kSliceSize, 3);
    parallelFor(kSliceSize, 8, threads, [&](size_t first, size_t last) {
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            for (int x = 0; x < kSliceSize; ++x) {
                const HalfDifference c = coordinatesOf(x, y, phiD);
                const BrdfValue f = foldedValue(model, c);
                const bool hatched = (x + y) % 8 < 2;
                if (isBelowHorizon(c)) {
                    picture.setRgb(x, y, glm::vec3(kHorizonGrey));
                } else if (f.confidence < kCoveredConfidence && hatched) {
                    picture.setRgb(x, y, {0.6f, 0.1f, 0.5f});
                } else {
                    picture.setRgb(x, y, logarithmic(f.value, peak));
                }
            }
        }
    });
    return picture;
}

// Of a few thousand configurations; the highlight's own peak, thetaH = 0, is among them.
float largestValue(const BrdfModel& model)
{
    float peak = 0;
    const auto include = [&](const BrdfValue& f) {
        if (f.confidence >= kCoveredConfidence) {
            peak = std::max({peak, f.value.x, f.value.y, f.value.z});
        }
    };
    for (int degrees = 0; degrees < 80; ++degrees) {
        include(foldedValue(model, {0, glm::radians(static_cast<float>(degrees)), 0}));
    }
    for (const LightView& d : comparisonConfigurations(5000)) {
        include(evaluateCovered(model, kAxis, d.l, d.v));
    }
    return peak > 0 ? peak : 1;
}

Image ballRadiance(const BrdfModel& model, float lightDegrees, int threads)
{
    const float angle = glm::radians(lightDegrees);
    const glm::vec3 upperLeft = glm::normalize(glm::vec3(-1, 0.6f, 0));
    const Light light{std::sin(angle) * upperLeft + std::cos(angle) * kAxis};
    return materialBall(model, {&light, 1}, kBrdfBallSize, threads);
}

Image slicesSheet(const BrdfModel& model, int threads)
{
    const float peak = largestValue(model);
    std::vector<SheetCell> row;
    for (int degrees : {0, 45, 90}) {
        row.push_back({slicePicture(model, glm::radians(static_cast<float>(degrees)), peak, threads),
                       fmt::format("phiD {}, {} decades to {:.4g}/sr", degrees, kDecades, peak)});
    }
    return contactSheet({row}, kSliceSize, kSliceSize);
}

// The ball of the light that is nearest to the view sets the exposure of the first row; the second shows what a
// highlight leaves dark.
Image ballsSheet(const BrdfModel& model, int threads)
{
    std::vector<std::vector<SheetCell>> rows(2);
    float stops = 0;
    for (int degrees : {20, 50, 80, 110}) {
        const Image radiance = ballRadiance(model, static_cast<float>(degrees), threads);
        stops = rows[0].empty() ? std::round(automaticExposure(radiance) * 10) / 10 + 0.0f : stops; // no -0.0
        for (int r = 0; r < 2; ++r) {
            const float shown = stops + kBrighterStops * static_cast<float>(r);
            rows[r].push_back({displayedImage(radiance, {.exposureStops = shown}),
                               fmt::format("light {} degrees, {:.1f} stops", degrees, shown)});
        }
    }
    return contactSheet(rows, kBrdfBallSize, kBrdfBallSize);
}

} // namespace

void saveBrdfPictures(const std::filesystem::path& folder, const BrdfSource& source, bool replace, int threads)
{
    std::filesystem::create_directories(folder);
    for (const char* name : kPictures) {
        WholeOutput(folder / name, replace); // refuses now what it would refuse after the work
    }
    saveImage(folder / kPictures[0], slicesSheet(source.model, threads), PixelType::uint8);
    saveImage(folder / kPictures[1], ballsSheet(source.model, threads), PixelType::uint8);
}

} // namespace nacre
