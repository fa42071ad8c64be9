#include "acquisition/cast_shadows/full_height.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/surface/height_from_normals.h"

namespace nacre {

namespace {

// What to add at each pixel of the thinned map; pixels without a height take the mean of those around them that have
// one, so that the outline's pixels find one.
struct Lifts {
    int width, height;
    std::vector<float> values, weights;
};

Lifts widened(const Lifts& lifts)
{
    Lifts wide = lifts;
    for (int y = 0; y < lifts.height; ++y) {
        for (int x = 0; x < lifts.width; ++x) {
            const size_t i = static_cast<size_t>(y) * lifts.width + x;
            if (lifts.weights[i] > 0) {
                continue;
            }
            float sum = 0, count = 0;
            for (int row = std::max(0, y - 1); row <= std::min(lifts.height - 1, y + 1); ++row) {
                for (int column = std::max(0, x - 1); column <= std::min(lifts.width - 1, x + 1); ++column) {
                    const size_t k = static_cast<size_t>(row) * lifts.width + column;
                    sum += lifts.weights[k] * lifts.values[k];
                    count += lifts.weights[k];
                }
            }
            wide.values[i] = count > 0 ? sum / count : 0.0f;
            wide.weights[i] = count > 0 ? 1.0f : 0.0f;
        }
    }
    return wide;
}

// Bilinear over the pixels that have one; places in pixels of the thinned map, whole numbers at their middles.
float liftAt(const Lifts& lifts, float x, float y)
{
    const float left = std::floor(x), top = std::floor(y);
    float sum = 0, weight = 0;
    for (int k = 0; k < 4; ++k) {
        const int column = std::clamp(static_cast<int>(left) + k % 2, 0, lifts.width - 1),
                  row = std::clamp(static_cast<int>(top) + k / 2, 0, lifts.height - 1);
        const size_t i = static_cast<size_t>(row) * lifts.width + column;
        const float share = (k % 2 == 1 ? x - left : 1 - x + left) * (k / 2 == 1 ? y - top : 1 - y + top);
        sum += share * lifts.weights[i] * lifts.values[i];
        weight += share * lifts.weights[i];
    }
    return weight > 0 ? sum / weight : 0.0f;
}

// Of a map that is not thinned.
Image placed(const NormalMap& normals, const Image& height, glm::ivec2 origin)
{
    Image full(normals.width, normals.height, 1);
    for (int y = 0; y < height.height; ++y) {
        for (int x = 0; x < height.width; ++x) {
            full.values[normals.index(origin.x + x, origin.y + y)] =
                height.values[static_cast<size_t>(y) * height.width + x];
        }
    }
    return full;
}

// From the normals' own height to the thinned map's.
Lifts liftsOf(const NormalMap& normals, const Image& full, const NormalMap& thinned, const Image& height,
              const Thinning& thinning)
{
    Lifts lifts{thinned.width, thinned.height, std::vector<float>(thinned.normals.size(), 0.0f),
                std::vector<float>(thinned.normals.size(), 0.0f)};
    for (int y = 0; y < thinned.height; ++y) {
        for (int x = 0; x < thinned.width; ++x) {
            const size_t i = thinned.index(x, y);
            if (thinned.confidence[i] > 0) {
                const glm::ivec2 middle = thinning.middleOf(x, y);
                lifts.values[i] = static_cast<float>(thinning.spacing) * height.values[i] -
                                  full.values[normals.index(middle.x, middle.y)];
                lifts.weights[i] = 1;
            }
        }
    }
    return widened(widened(lifts));
}

} // namespace

Image fullHeight(const NormalMap& normals, const NormalMap& thinned, const Image& height, const Thinning& thinning,
                 int threads)
{
    if (thinning.spacing == 1) {
        return placed(normals, height, thinning.origin);
    }
    Image full = heightFromNormals(normals, {.threads = threads}).height;
    const Lifts lifts = liftsOf(normals, full, thinned, height, thinning);
    const glm::vec2 first(thinning.middleOf(0, 0));
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            const size_t pixel = normals.index(x, y);
            if (normals.confidence[pixel] > 0) {
                const glm::vec2 place = (glm::vec2(x, y) - first) / static_cast<float>(thinning.spacing);
                full.values[pixel] += liftAt(lifts, place.x, place.y);
            }
        }
    }
    return full;
}

} // namespace nacre
