#include "app/page/page_photographs.h"

#include <numeric>

#include <fmt/format.h>

#include "acquisition/lights/well_spread_lights.h"
#include "app/materials/captured_photographs.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/page/page_shape.h"

namespace nacre {
namespace {

constexpr int kQuality = 88; // of JPEG: its errors are below the eye's, and a higher one costs bytes alone

std::vector<size_t> spreadLights(const Surface& surface, int count)
{
    std::vector<glm::vec3> directions;
    for (const CapturedLight& captured : surface.lights) {
        directions.push_back(captured.light.direction);
    }
    std::vector<size_t> all(directions.size());
    std::iota(all.begin(), all.end(), size_t{0});
    if (static_cast<size_t>(count) > all.size()) {
        throw Error("", fmt::format("--photographs {} are not there", count),
                    fmt::format("at most {}, the captured lights", all.size()), Error::kUsage);
    }
    return farthestFirst(directions, all, static_cast<size_t>(count));
}

} // namespace

std::vector<PagePhotograph> photographsForPage(const std::filesystem::path& capture,
                                               const std::filesystem::path& folder, const Surface& surface, int count)
{
    const std::vector<size_t> lights = spreadLights(surface, count);
    const std::unique_ptr<Photographs> photographs = photographsOf(capture, folder);
    photographs->load([](float) {}, std::atomic<bool>(false));
    const TemporaryFolder temporary;
    const std::filesystem::path file = temporary.path() / "photograph.jpg";
    const PageCrop crop = cropOf(surface.normals);
    std::vector<PagePhotograph> pages;
    for (const size_t light : lights) {
        const Image picture = cropped(photographs->picture(light), crop);
        const float stops = automaticExposure(picture);
        saveImage(file, displayedImage(picture, {.exposureStops = stops}), PixelType::uint8,
                  {{"Compression", fmt::format("jpeg:{}", kQuality)}});
        pages.push_back({light, readWholeFile(file, "a picture"), stops});
    }
    return pages;
}

} // namespace nacre
