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

} // namespace

Image fullHeight(const NormalMap& normals, const NormalMap& thinned, const Image& height, int spacing, int threads)
{
    if (spacing == 1) {
        return height;
    }
    Image full = heightFromNormals(normals, {.threads = threads}).height;
    Lifts lifts{thinned.width, thinned.height, std::vector<float>(thinned.normals.size(), 0.0f),
                std::vector<float>(thinned.normals.size(), 0.0f)};
    for (int y = 0; y < thinned.height; ++y) {
        for (int x = 0; x < thinned.width; ++x) {
            const size_t i = thinned.index(x, y);
            const size_t pixel = normals.index(std::min(normals.width - 1, x * spacing + spacing / 2),
                                               std::min(normals.height - 1, y * spacing + spacing / 2));
            if (thinned.confidence[i] > 0) {
                lifts.values[i] = static_cast<float>(spacing) * height.values[i] - full.values[pixel];
                lifts.weights[i] = 1;
            }
        }
    }
    lifts = widened(widened(lifts));
    for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x) {
            const size_t pixel = normals.index(x, y);
            if (normals.confidence[pixel] > 0) {
                const auto place = [&](int whole) {
                    return (static_cast<float>(whole) - static_cast<float>(spacing / 2)) / static_cast<float>(spacing);
                };
                full.values[pixel] += liftAt(lifts, place(x), place(y));
            }
        }
    }
    return full;
}

} // namespace nacre
