#include "acquisition/lights/sphere_in_picture.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "acquisition/capture/sphere_specification.h"
#include "acquisition/lights/circle_search.h"
#include "acquisition/lights/sphere_outline.h"
#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/measures.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr size_t kMostPhotographs = 15; // little to read
// Of a pixel's values: a highlight is brighter in one or two of the photographs, and the sphere's own shadow on what it
// stands on is there, beside the outline, in up to half of them.
constexpr double kUsualQuantile = 0.75;

void requireInside(const SphereInPicture& sphere, const Capture& capture)
{
    const FileWindow& files = capture.window;
    const bool inside = sphere.width <= files.fileWidth && sphere.height <= files.fileHeight &&
                        sphere.x <= files.fileWidth - sphere.width && sphere.y <= files.fileHeight - sphere.height;
    if (!inside) {
        throw Error(capture.photographs[0].exposures[0].file,
                    fmt::format("is {} x {}, the sphere's crop {} is not inside", files.fileWidth, files.fileHeight,
                                rectangleOf(sphere)),
                    "X,Y,W,H in pixels, the top left pixel being 0,0");
    }
}

// Grey values of the crop.
std::vector<float> cropOf(const SphereInPicture& sphere, const fs::path& file, TransferCurve curve)
{
    ImageRows rows(file, curve);
    const int channels = rows.channels();
    const size_t width = rows.header().width;
    std::vector<float> values(width * sphere.height * channels);
    rows.read(sphere.y, sphere.y + sphere.height, values);
    std::vector<float> crop;
    crop.reserve(static_cast<size_t>(sphere.width) * sphere.height);
    for (int y = 0; y < sphere.height; ++y) {
        for (int x = 0; x < sphere.width; ++x) {
            const float* p = &values[(y * width + sphere.x + x) * channels];
            crop.push_back(channels == 3 ? channelMean({p[0], p[1], p[2]}) : p[0]);
        }
    }
    return crop;
}

Image usualCrop(const SphereInPicture& sphere, const Capture& capture)
{
    const size_t all = capture.photographs.size(), count = std::min(all, kMostPhotographs);
    std::vector<std::vector<float>> crops;
    for (size_t i = 0; i < count; ++i) {
        crops.push_back(cropOf(sphere, capture.photographs[i * all / count].exposures[0].file, capture.curve));
    }
    Image usual(sphere.width, sphere.height, 1);
    std::vector<float> values(count);
    for (size_t pixel = 0; pixel < usual.values.size(); ++pixel) {
        std::transform(crops.begin(), crops.end(), values.begin(), [pixel](const auto& crop) { return crop[pixel]; });
        usual.values[pixel] = quantile(values, kUsualQuantile);
    }
    return usual;
}

// Of the crop's size.
std::vector<uint8_t> loadSphereMask(const SphereInPicture& sphere, const FileWindow& files)
{
    const ImageHeader header = readImageHeader(sphere.mask);
    if (header.width == sphere.width && header.height == sphere.height) {
        return loadMask(sphere.mask, sphere.width, sphere.height);
    }
    if (header.width != files.fileWidth || header.height != files.fileHeight) {
        throw Error(sphere.mask, fmt::format("is {} x {}", header.width, header.height),
                    fmt::format("{} x {} as the photographs, or {} x {} as the sphere's crop", files.fileWidth,
                                files.fileHeight, sphere.width, sphere.height));
    }
    const std::vector<uint8_t> whole = loadMask(sphere.mask, header.width, header.height);
    std::vector<uint8_t> crop;
    for (int y = 0; y < sphere.height; ++y) {
        const auto row = whole.begin() + static_cast<std::ptrdiff_t>(sphere.y + y) * header.width + sphere.x;
        crop.insert(crop.end(), row, row + sphere.width);
    }
    return crop;
}

} // namespace

Circle circleInPicture(const SphereInPicture& sphere, const Capture& capture)
{
    requireInside(sphere, capture);
    std::optional<Circle> circle;
    if (!sphere.mask.empty()) {
        circle = fitCircle(loadSphereMask(sphere, capture.window), sphere.width, sphere.height, sphere.mask);
    } else {
        circle = findCircle(usualCrop(sphere, capture));
    }
    if (!circle) {
        throw Error(capture.photographs[0].exposures[0].file,
                    fmt::format("shows no outline of a sphere at {}", rectangleOf(sphere)),
                    "X,Y,W,H around one sphere and little else, or its mask after the numbers");
    }
    return {circle->x + sphere.x, circle->y + sphere.y, circle->radius};
}

} // namespace nacre
