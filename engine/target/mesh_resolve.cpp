#include "engine/target/mesh_resolve.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

// Within a pixel the height of one surface changes by less, up to 79 degrees; what is farther behind is another one,
// and the mean with it would be a normal that neither has.
constexpr float kSameSurface = 5; // pixels

glm::vec3 normalOfSample(const glm::vec4& sample)
{
    return {sample.x, sample.y, std::sqrt(std::max(0.0f, 1 - sample.x * sample.x - sample.y * sample.y))};
}

void resolvePixel(const glm::vec4* first, size_t pitch, int samplesPerSide, size_t pixel, Surface& surface)
{
    const glm::vec4* nearest = nullptr;
    int covered = 0;
    for (int k = 0; k < samplesPerSide * samplesPerSide; ++k) {
        const glm::vec4& sample = first[k / samplesPerSide * pitch + k % samplesPerSide];
        if (sample.w > 0) {
            ++covered;
            nearest = !nearest || sample.z > nearest->z ? &sample : nearest;
        }
    }
    if (2 * covered < samplesPerSide * samplesPerSide || !nearest) {
        return;
    }
    glm::vec3 normal(0);
    float height = 0, count = 0;
    for (int k = 0; k < samplesPerSide * samplesPerSide; ++k) {
        const glm::vec4& sample = first[k / samplesPerSide * pitch + k % samplesPerSide];
        if (sample.w == nearest->w && nearest->z - sample.z <= kSameSurface) {
            normal += normalOfSample(sample);
            height += sample.z;
            ++count;
        }
    }
    surface.normals.normals[pixel] = glm::normalize(normal);
    surface.normals.confidence[pixel] = 1;
    surface.height.values[pixel] = height / count;
    surface.labels[pixel] = static_cast<uint8_t>(nearest->w - 0.5f);
}

} // namespace

Surface resolvedSurface(const glm::vec4* samples, int width, int height, int samplesPerSide)
{
    Surface surface;
    surface.normals = NormalMap(width, height);
    surface.height = Image(width, height, 1);
    surface.labels.assign(surface.height.pixelCount(), Surface::kNoMaterial);
    const size_t pitch = static_cast<size_t>(width) * samplesPerSide;
    parallelFor(height, 32, 0, [&](size_t top, size_t bottom) {
        for (size_t y = top; y < bottom; ++y) {
            for (size_t x = 0; x < static_cast<size_t>(width); ++x) {
                resolvePixel(samples + (y * pitch + x) * samplesPerSide, pitch, samplesPerSide, y * width + x, surface);
            }
        }
    });
    return surface;
}

} // namespace nacre
