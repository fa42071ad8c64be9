#include "app/materials/rti_fits.h"

#include <algorithm>
#include <utility>

#include "engine/files/parallel_for.h"
#include "engine/scene/picture_size.h"
#include "engine/scene/reference.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace {

constexpr size_t kRowsAtOnce = 16;
constexpr int kExposureSide = 96; // pixels: enough for a percentile, few enough for all lights at once

Frame radianceUnder(Scene& scene, const glm::vec3& light, int threads)
{
    scene.lights = {{light, glm::vec3(1)}};
    return renderReference(scene, threads);
}

// displayImage by rows on all threads.
Image displayedOnThreads(const Frame& radiance, float stops, int threads)
{
    Image picture(radiance.width, radiance.height, 3);
    parallelFor(radiance.height, kRowsAtOnce, threads, [&](size_t first, size_t last) {
        Image rows(radiance.width, static_cast<int>(last - first), 3);
        const auto offset = static_cast<std::ptrdiff_t>(radiance.index(0, static_cast<int>(first)));
        std::copy_n(radiance.values.begin() + offset, rows.values.size(), rows.values.begin());
        rows = displayedImage(rows, {.exposureStops = stops});
        std::copy(rows.values.begin(), rows.values.end(), picture.values.begin() + offset);
    });
    return picture;
}

float commonExposure(const Surface& surface, const std::vector<glm::vec3>& lights, int threads)
{
    Scene small{fittedSurface(surface, kExposureSide, kExposureSide), {}};
    Image all(kExposureSide, kExposureSide * static_cast<int>(lights.size()), 3);
    auto end = all.values.begin();
    for (const glm::vec3& light : lights) {
        const Frame frame = radianceUnder(small, light, threads);
        end = std::copy(frame.values.begin(), frame.values.end(), end);
    }
    return automaticExposure(all);
}

// 1 where there is a normal with a material.
std::vector<uint8_t> maskOf(const Surface& surface)
{
    std::vector<uint8_t> mask(surface.labels.size(), 0);
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = surface.normals.confidence[i] > 0 && surface.labels[i] < surface.materials.size();
    }
    return mask;
}

} // namespace

RtiFits::RtiFits(Surface surface, std::span<const RtiBasis> bases, const RtiFitOptions& options)
    : scene_{std::move(surface), {}}, lights_(rtiLights(options.lights)),
      stops_(options.exposureStops ? *options.exposureStops : commonExposure(scene_.surface, lights_, options.threads)),
      threads_(options.threads),
      fits_(fitRti([this](const glm::vec3& light) { return pictureUnder(light); }, bases, lights_, threads_))
{
}

const RtiPicture& RtiFits::of(RtiBasis basis) const
{
    return *std::find_if(fits_.begin(), fits_.end(), [&](const RtiPicture& fit) { return fit.basis == basis; });
}

double RtiFits::psnrOf(const RtiPicture& fromFile)
{
    return rtiPsnr(
        fromFile, [this](const glm::vec3& light) { return pictureUnder(light); }, rtiCheckLights(),
        maskOf(scene_.surface), threads_);
}

Image RtiFits::pictureUnder(const glm::vec3& light)
{
    return displayedOnThreads(radianceUnder(scene_, light, threads_), stops_, threads_);
}

} // namespace nacre
