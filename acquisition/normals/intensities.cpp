#include "acquisition/normals/intensities.h"

#include <algorithm>
#include <iterator>

#include "engine/files/measures.h"

namespace nacre {

Intensities makeIntensities(size_t pixels, size_t lightCount)
{
    Intensities result;
    result.lightCount = lightCount;
    result.stride = (lightCount + 7) / 8 * 8;
    result.values.assign(pixels * result.stride, 0.0f);
    return result;
}

Intensities intensitiesOf(const Observations& block, const std::vector<Light>& lights)
{
    Intensities result = makeIntensities(block.pixels.size(), lights.size());
    result.places = block.pixels;
    result.width = block.width;
    result.spacing = block.spacing;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const auto radiance = block.radianceOf(p);
        const auto saturated = block.saturatedOf(p);
        for (size_t i = 0; i < lights.size(); ++i) {
            result.values[p * result.stride + i] = saturated[i] ? kClipped : greyOf(radiance[i] / lights[i].irradiance);
        }
    }
    return result;
}

float brightLevel(std::span<const float> observed)
{
    thread_local std::vector<float> values;
    values.clear();
    std::copy_if(observed.begin(), observed.end(), std::back_inserter(values), [](float v) { return !isClipped(v); });
    return values.empty() ? 0.0f : quantile(values, 0.9);
}

Intensities selectLights(const Intensities& intensities, const std::vector<size_t>& lights)
{
    Intensities result = makeIntensities(intensities.pixelCount(), lights.size());
    result.places = intensities.places;
    result.width = intensities.width;
    result.spacing = intensities.spacing;
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        for (size_t i = 0; i < lights.size(); ++i) {
            result.values[p * result.stride + i] = intensities.ofPixel(p)[lights[i]];
        }
    }
    return result;
}

std::vector<size_t> spreadPixels(size_t pixels, size_t most)
{
    std::vector<size_t> chosen(std::min(most, pixels));
    for (size_t j = 0; j < chosen.size(); ++j) {
        chosen[j] = (2 * j + 1) * pixels / (2 * chosen.size());
    }
    return chosen;
}

Intensities selectPixels(const Intensities& intensities, const std::vector<size_t>& pixels)
{
    Intensities result = makeIntensities(pixels.size(), intensities.lightCount);
    result.width = intensities.width;
    result.spacing = intensities.spacing;
    for (size_t j = 0; j < pixels.size(); ++j) {
        if (result.width > 0) {
            result.places.push_back(intensities.places[pixels[j]]);
        }
        std::copy_n(intensities.padded(pixels[j]), intensities.stride, &result.values[j * result.stride]);
    }
    return result;
}

} // namespace nacre
