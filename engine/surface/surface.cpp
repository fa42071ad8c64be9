#include "engine/surface/surface.h"

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

size_t bytesOf(const Material& material)
{
    return material.compact ? bytesOf(*material.compact)
                            : material.table.values.size() * bytesPerTexel(TexelFormat::rgba32f);
}

Surface transferredSurface(const NormalMap& normals, const Material& material)
{
    Surface surface;
    surface.normals = normals;
    surface.materials = {material};
    surface.labels.assign(normals.normals.size(), Surface::kNoMaterial);
    for (size_t i = 0; i < surface.labels.size(); ++i) {
        if (normals.confidence[i] > 0) {
            surface.labels[i] = 0;
        }
    }
    return surface;
}

Surface transferredSurface(const Surface& target, const Material& material)
{
    Surface surface = transferredSurface(target.normals, material);
    surface.height = target.height;
    surface.horizon = target.horizon;
    surface.camera = target.camera;
    return surface;
}

Surface fittedSurface(const Surface& surface, int width, int height)
{
    Surface fitted = surface;
    fitted.normals = fittedNormalMap(surface.normals, width, height);
    fitted.labels.assign(fitted.normals.normals.size(), Surface::kNoMaterial);
    fitted.places.clear();
    const bool hasAlbedo = !surface.albedo.values.empty();
    fitted.albedo = hasAlbedo ? Image(width, height, 3, 1.0f) : Image();
    const bool hasHeight = !surface.height.values.empty();
    fitted.height = hasHeight ? Image(width, height, 1) : Image();
    // Heights are in pixels, which shrink and grow with the picture.
    const float scale = std::min(static_cast<float>(width) / static_cast<float>(surface.normals.width),
                                 static_cast<float>(height) / static_cast<float>(surface.normals.height));
    if (surface.pixelsPerMillimetre) {
        fitted.pixelsPerMillimetre = scale * *surface.pixelsPerMillimetre;
    }
    const std::vector<int64_t> from = fittedPixels(surface.normals.width, surface.normals.height, width, height);
    fitted.horizon = pickedHorizon(surface.horizon, from, width, height);
    fitted.residual = pickedResidual(surface.residual, from, width, height);
    for (size_t i = 0; i < from.size(); ++i) {
        if (from[i] < 0) {
            continue;
        }
        fitted.labels[i] = surface.labels[from[i]];
        if (hasHeight) {
            fitted.height.values[i] = scale * surface.height.values[from[i]];
        }
        if (hasAlbedo) {
            std::copy_n(&surface.albedo.values[3 * from[i]], 3, &fitted.albedo.values[3 * i]);
        }
    }
    return fitted;
}

Surface sampledPixels(const Surface& surface, size_t most)
{
    const std::vector<size_t> all = shadedPixels(surface);
    const size_t count = std::min(most, all.size());
    const int width = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
    const int height = std::max(1, static_cast<int>((count + width - 1) / width));
    Surface sample;
    sample.camera = surface.camera;
    sample.normals = NormalMap(width, height);
    sample.labels.assign(sample.normals.normals.size(), Surface::kNoMaterial);
    const bool hasAlbedo = !surface.albedo.values.empty();
    sample.albedo = hasAlbedo ? Image(width, height, 3, 1.0f) : Image();
    sample.places.resize(surface.places.empty() ? 0 : sample.labels.size());
    std::vector<int64_t> picked(sample.labels.size(), -1);
    for (size_t i = 0; i < count; ++i) {
        const size_t from = all[i * all.size() / count];
        picked[i] = static_cast<int64_t>(from);
        sample.normals.normals[i] = surface.normals.normals[from];
        sample.normals.confidence[i] = surface.normals.confidence[from];
        sample.labels[i] = surface.labels[from];
        if (!surface.places.empty()) {
            sample.places[i] = surface.places[from];
        }
        if (hasAlbedo) {
            std::copy_n(&surface.albedo.values[3 * from], 3, &sample.albedo.values[3 * i]);
        }
    }
    sample.horizon = pickedHorizon(surface.horizon, picked, width, height);
    sample.residual = pickedResidual(surface.residual, picked, width, height);
    return sample;
}

} // namespace nacre
