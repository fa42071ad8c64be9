#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"

namespace nacre {

// What a block of mask pixels shows under every light: radiance on the capture's common scale (integers divided by
// their full scale, the capture's offset subtracted, exposure time divided out, brackets merged, the ambient photograph
// subtracted, so that noise may leave values below 0); grey photographs have three equal channels.
struct Observations {
    size_t lightCount = 0;
    std::vector<uint32_t> pixels;    // y * width + x, ascending
    std::vector<glm::vec3> radiance; // [pixel * lightCount + light]
    std::vector<uint8_t> saturated;  // same shape: 1 where a channel was clipped in every exposure
    int width = 0;                   // of the picture; 0: not known
    int spacing = 1;                 // each pixel stands for a square of so many

    std::span<const glm::vec3> radianceOf(size_t pixel) const
    {
        return std::span(radiance).subspan(pixel * lightCount, lightCount);
    }
    std::span<const uint8_t> saturatedOf(size_t pixel) const
    {
        return std::span(saturated).subspan(pixel * lightCount, lightCount);
    }
};

// What the lights that are named show, leaving others out.
Observations selectLights(const Observations& block, const std::vector<size_t>& lights);

// Marks what reaches the end, by channel, as clipped.
void clipAt(const glm::vec3& end, Observations& block);

// Walks a capture in bands of rows, all photographs side by side, so that memory is bounded by the block and not by
// the capture. A capture that fits into the budget is one block.
class ObservationReader {
public:
    static constexpr size_t kDefaultByteBudget = size_t{512} << 20;

    explicit ObservationReader(const Capture& capture, int threads = 0, size_t byteBudget = kDefaultByteBudget);
    ~ObservationReader();
    ObservationReader(ObservationReader&&) noexcept;
    ObservationReader& operator=(ObservationReader&&) noexcept;

    // The next block; false at the end. Throws Error: unreadable photograph, NaN or infinite values.
    bool next(Observations& block);

private:
    struct State;
    std::unique_ptr<State> state_;
};

// A few thousand of the pixels (of a picture so wide, ascending): of each square of `spacing` the one nearest to its
// middle. All of them where they are no more.
struct PixelSample {
    int spacing = 1;
    std::vector<uint32_t> pixels; // ascending
};
PixelSample samplePixels(const std::vector<uint32_t>& pixels, int width);

// Adds those of the block's pixels that are in the sample, and takes the block's shape over.
void addToSample(const Observations& block, const PixelSample& chosen, Observations& sample);

// A few thousand pixels spread evenly over what was seen.
Observations evenSample(const Observations& whole);

} // namespace nacre
