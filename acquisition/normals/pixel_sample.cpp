#include "acquisition/normals/pixel_sample.h"

#include <algorithm>

namespace nacre {

namespace {

constexpr size_t kMostPixels = 4000;

// Adds the block's pixels whose number on the mask is a multiple of `step`.
void addPixels(const Observations& block, size_t firstNumber, size_t step, Observations& sample)
{
    const size_t n = block.lightCount;
    for (size_t p = (step - firstNumber % step) % step; p < block.pixels.size(); p += step) {
        sample.pixels.push_back(block.pixels[p]);
        const auto saturated = block.saturatedOf(p);
        sample.saturated.insert(sample.saturated.end(), saturated.begin(), saturated.end());
        sample.radiance.insert(sample.radiance.end(), block.radiance.begin() + p * n,
                               block.radiance.begin() + (p + 1) * n);
    }
}

size_t stepOver(size_t pixels)
{
    return std::max<size_t>(1, (pixels + kMostPixels - 1) / kMostPixels);
}

} // namespace

Observations evenSample(const Observations& whole)
{
    Observations sample;
    sample.lightCount = whole.lightCount;
    addPixels(whole, 0, stepOver(whole.pixels.size()), sample);
    return sample;
}

Observations samplePixels(const Capture& capture, const Observations& first, int threads, size_t byteBudget)
{
    if (first.pixels.size() == capture.maskPixels) {
        return evenSample(first);
    }
    Observations sample;
    sample.lightCount = first.lightCount;
    ObservationReader reader(capture, threads, byteBudget);
    Observations block;
    for (size_t seen = 0; reader.next(block); seen += block.pixels.size()) {
        addPixels(block, seen, stepOver(capture.maskPixels), sample);
    }
    return sample;
}

} // namespace nacre
