#include "acquisition/normals/pixel_sample.h"

#include <algorithm>

namespace nacre {

namespace {

constexpr size_t kMostPixels = 4000;

} // namespace

size_t sampleStep(size_t pixels)
{
    return std::max<size_t>(1, (pixels + kMostPixels - 1) / kMostPixels);
}

void addToSample(const Observations& block, size_t firstNumber, size_t step, Observations& sample)
{
    const size_t n = block.lightCount;
    sample.lightCount = n;
    for (size_t p = (step - firstNumber % step) % step; p < block.pixels.size(); p += step) {
        sample.pixels.push_back(block.pixels[p]);
        const auto saturated = block.saturatedOf(p);
        sample.saturated.insert(sample.saturated.end(), saturated.begin(), saturated.end());
        sample.radiance.insert(sample.radiance.end(), block.radiance.begin() + p * n,
                               block.radiance.begin() + (p + 1) * n);
    }
}

Observations evenSample(const Observations& whole)
{
    Observations sample;
    addToSample(whole, 0, sampleStep(whole.pixels.size()), sample);
    return sample;
}

} // namespace nacre
