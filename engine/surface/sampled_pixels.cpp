#include "engine/surface/sampled_pixels.h"

#include <algorithm>
#include <cmath>

namespace nacre {
namespace {

std::vector<size_t> shadedPixels(const Surface& surface)
{
    std::vector<size_t> pixels;
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (isShaded(surface, i)) {
            pixels.push_back(i);
        }
    }
    return pixels;
}

} // namespace

Surface sampledPixels(const Surface& surface, size_t most)
{
    const std::vector<size_t> all = shadedPixels(surface);
    const size_t count = std::min(most, all.size());
    const int width = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
    const int height = std::max(1, static_cast<int>((count + width - 1) / width));
    Surface sample;
    sample.normals = NormalMap(width, height);
    sample.labels.assign(sample.normals.normals.size(), Surface::kNoMaterial);
    const bool hasAlbedo = !surface.albedo.values.empty();
    sample.albedo = hasAlbedo ? Image(width, height, 3, 1.0f) : Image();
    std::vector<int64_t> picked(sample.labels.size(), -1);
    for (size_t i = 0; i < count; ++i) {
        const size_t from = all[i * all.size() / count];
        picked[i] = static_cast<int64_t>(from);
        sample.normals.normals[i] = surface.normals.normals[from];
        sample.normals.confidence[i] = surface.normals.confidence[from];
        sample.labels[i] = surface.labels[from];
        if (hasAlbedo) {
            std::copy_n(&surface.albedo.values[3 * from], 3, &sample.albedo.values[3 * i]);
        }
    }
    sample.horizon = pickedHorizon(surface.horizon, picked, width, height);
    sample.residual = pickedResidual(surface.residual, picked, width, height);
    return sample;
}

} // namespace nacre
