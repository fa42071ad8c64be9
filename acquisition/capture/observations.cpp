#include "acquisition/capture/observations.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <glm/vector_relational.hpp>

#include "acquisition/capture/photograph_files.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

// Rows decoded at once, since each call costs a buffer inside the decoder. Fewer where the budget is small.
constexpr size_t kRowsAtOnce = 64;
constexpr size_t kRowBytesPerPixel = 4 * sizeof(float); // up to four channels

// Rows [first, last).
struct Band {
    int first;
    int last;
};

} // namespace

struct ObservationReader::State {
    State(const Capture& capture, int threads, size_t byteBudget);

    size_t exposureCount() const;
    size_t lightCount() const { return photographs.size() - (hasAmbient ? 1 : 0); }
    size_t bytesPerPixel() const
    {
        return lightCount() * (sizeof(glm::vec3) + 1) + sizeof(uint32_t) + (hasAmbient ? sizeof(MergedPixel) : 0);
    }
    size_t pixelsIn(int first, int last) const { return pixelsAbove[last] - pixelsAbove[first]; }
    void chooseRowsAtOnce(size_t byteBudget);
    void planBands(size_t byteBudget);
    size_t keepFilesOpen(size_t byteBudget);
    void listPixels(const Band& band, Observations& block) const;
    // store(index in pixels, what is seen there) for each.
    template <class Store>
    void readPhotograph(std::vector<ExposureFile>& files, const Band& band, const std::vector<uint32_t>& pixels,
                        Store&& store);
    void readAmbient(const Band& band, const std::vector<uint32_t>& pixels);
    void readLight(size_t light, const Band& band, Observations& block);

    int width;
    int height;
    size_t rowBytes; // read of a file for a row of the capture
    int threads;
    std::vector<uint8_t> mask;
    std::vector<size_t> pixelsAbove; // mask pixels in the rows above each row, and in all
    int rowsAtOnce = 1;
    std::vector<Band> bands;
    size_t nextBand = 0;
    std::optional<TemporaryFolder> copies;              // outlives the files, which read from it
    std::vector<std::vector<ExposureFile>> photographs; // one per light, then the ambient one
    bool hasAmbient;
    std::vector<MergedPixel> ambient; // of the block
};

ObservationReader::State::State(const Capture& capture, int threadCount, size_t byteBudget)
    : width(capture.width), height(capture.height),
      rowBytes(kRowBytesPerPixel * std::max(capture.width, capture.window.fileWidth) * capture.window.box),
      threads(threadCount > 0 ? threadCount : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))),
      mask(capture.mask), pixelsAbove(height + 1, 0), hasAmbient(capture.ambient.has_value())
{
    for (int y = 0; y < height; ++y) {
        const auto row = mask.begin() + static_cast<ptrdiff_t>(y) * width;
        pixelsAbove[y + 1] =
            pixelsAbove[y] + std::count_if(row, row + width, [](uint8_t inside) { return inside != 0; });
    }
    const auto addPhotograph = [&](const Photograph& photograph) {
        std::vector<ExposureFile>& files = photographs.emplace_back();
        for (const Exposure& exposure : photograph.exposures) {
            files.emplace_back(exposure, capture);
        }
    };
    std::for_each(capture.photographs.begin(), capture.photographs.end(), addPhotograph);
    if (hasAmbient) {
        addPhotograph(*capture.ambient);
    }
    chooseRowsAtOnce(byteBudget / 4);
    const size_t rowBuffers = rowBytes * rowsAtOnce * (exposureCount() + threads);
    const size_t blockBudget = byteBudget - std::min(byteBudget, rowBuffers);
    planBands(blockBudget);
    if (bands.size() > 1) { // otherwise each file is opened once, one after the other
        const size_t held = keepFilesOpen(byteBudget / 2);
        planBands(blockBudget - std::min(blockBudget, held));
    }
}

size_t ObservationReader::State::exposureCount() const
{
    return std::accumulate(photographs.begin(), photographs.end(), size_t{0},
                           [](size_t sum, const auto& files) { return sum + files.size(); });
}

void ObservationReader::State::chooseRowsAtOnce(size_t byteBudget)
{
    const size_t bytesOfRow = rowBytes * (exposureCount() + threads);
    rowsAtOnce = static_cast<int>(std::clamp(byteBudget / std::max<size_t>(bytesOfRow, 1), size_t{1}, kRowsAtOnce));
}

// As many rows a band as the budget holds, at least one; rows without mask pixels between bands are left out.
void ObservationReader::State::planBands(size_t byteBudget)
{
    bands.clear();
    int first = 0;
    while (first < height) {
        if (pixelsIn(first, first + 1) == 0) {
            ++first;
            continue;
        }
        int last = first + 1;
        while (last < height && pixelsIn(first, last + 1) * bytesPerPixel() <= byteBudget) {
            ++last;
        }
        bands.push_back({first, last});
        first = last;
    }
}

// Files beyond the system's allowance are opened for each band anew. Pictures that cannot be streamed are held while
// the budget lasts, then copied. Answers the bytes held.
size_t ObservationReader::State::keepFilesOpen(size_t byteBudget)
{
    size_t held = 0;
    size_t opened = 0;
    const size_t allowed = openFileAllowance();
    for (std::vector<ExposureFile>& files : photographs) {
        for (ExposureFile& file : files) {
            if (opened++ == allowed) {
                return held;
            }
            const size_t bytes = file.keepOpen();
            if (held + bytes <= byteBudget) {
                held += bytes;
                continue;
            }
            if (!copies) {
                copies.emplace();
            }
            file.spill(copies->path() / std::to_string(opened));
        }
    }
    return held;
}

void ObservationReader::State::listPixels(const Band& band, Observations& block) const
{
    block.lightCount = lightCount();
    block.width = width;
    block.pixels.clear();
    block.pixels.reserve(pixelsIn(band.first, band.last));
    for (int y = band.first; y < band.last; ++y) {
        for (int x = 0; x < width; ++x) {
            const size_t pixel = static_cast<size_t>(y) * width + x;
            if (mask[pixel]) {
                block.pixels.push_back(static_cast<uint32_t>(pixel));
            }
        }
    }
}

namespace {

void requireFinite(const glm::vec3& value, const ExposureFile& file, uint32_t pixel, int width)
{
    if (!std::isfinite(value.x) || !std::isfinite(value.y) || !std::isfinite(value.z)) {
        throw Error(file.file(), fmt::format("is not finite at pixel ({}, {})", pixel % width, pixel / width),
                    "finite values inside the mask");
    }
}

} // namespace

template <class Store>
void ObservationReader::State::readPhotograph(std::vector<ExposureFile>& files, const Band& band,
                                              const std::vector<uint32_t>& pixels, Store&& store)
{
    std::vector<std::vector<glm::vec3>> rows(files.size());
    std::vector<ExposureScale> scales(files.size());
    std::vector<glm::vec3> values(files.size());
    size_t next = 0; // of pixels
    for (int first = band.first; first < band.last; first += rowsAtOnce) {
        const int last = std::min(first + rowsAtOnce, band.last);
        if (pixelsIn(first, last) == 0) {
            continue;
        }
        for (size_t e = 0; e < files.size(); ++e) {
            files[e].read(first, last, rows[e]);
            scales[e] = files[e].scale();
        }
        const size_t start = static_cast<size_t>(first) * width;
        for (const size_t end = next + pixelsIn(first, last); next < end; ++next) {
            const uint32_t pixel = pixels[next];
            for (size_t e = 0; e < files.size(); ++e) {
                values[e] = rows[e][pixel - start];
                requireFinite(values[e], files[e], pixel, width);
            }
            store(next, mergeExposures(values, scales));
        }
    }
    for (ExposureFile& file : files) {
        file.endBand();
    }
}

void ObservationReader::State::readAmbient(const Band& band, const std::vector<uint32_t>& pixels)
{
    ambient.resize(pixels.size());
    readPhotograph(photographs.back(), band, pixels, [&](size_t i, const MergedPixel& seen) { ambient[i] = seen; });
}

// Fills the column of one light.
void ObservationReader::State::readLight(size_t light, const Band& band, Observations& block)
{
    readPhotograph(photographs[light], band, block.pixels, [&](size_t i, MergedPixel seen) {
        if (hasAmbient) {
            seen.radiance -= ambient[i].radiance;
            seen.saturated |= ambient[i].saturated;
        }
        block.radiance[i * block.lightCount + light] = seen.radiance;
        block.saturated[i * block.lightCount + light] = seen.saturated ? 1 : 0;
    });
}

ObservationReader::ObservationReader(const Capture& capture, int threads, size_t byteBudget)
    : state_(std::make_unique<State>(capture, threads, byteBudget))
{
}

ObservationReader::~ObservationReader() = default;
ObservationReader::ObservationReader(ObservationReader&&) noexcept = default;
ObservationReader& ObservationReader::operator=(ObservationReader&&) noexcept = default;

bool ObservationReader::next(Observations& block)
{
    State& s = *state_;
    if (s.nextBand == s.bands.size()) {
        return false;
    }
    const Band band = s.bands[s.nextBand++];
    s.listPixels(band, block);
    const size_t values = block.pixels.size() * block.lightCount;
    if (block.radiance.capacity() < values) {
        block.radiance = {}; // first, or both the old and the new would be there for a moment
        block.saturated = {};
    }
    block.radiance.resize(values);
    block.saturated.resize(values);
    if (s.hasAmbient) {
        s.readAmbient(band, block.pixels);
    }
    // Whatever thread meets an error first, the first photograph's is thrown.
    std::vector<std::exception_ptr> errors(s.lightCount());
    parallelFor(s.lightCount(), 1, s.threads, [&](size_t first, size_t last) {
        for (size_t light = first; light < last; ++light) {
            try {
                s.readLight(light, band, block);
            } catch (...) {
                errors[light] = std::current_exception();
            }
        }
    });
    for (const std::exception_ptr& error : errors) {
        if (error) {
            std::rethrow_exception(error);
        }
    }
    return true;
}

Observations selectLights(const Observations& block, const std::vector<size_t>& lights)
{
    Observations selected;
    selected.lightCount = lights.size();
    selected.width = block.width;
    selected.spacing = block.spacing;
    selected.pixels = block.pixels;
    selected.radiance.reserve(block.pixels.size() * lights.size());
    selected.saturated.reserve(block.pixels.size() * lights.size());
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        for (const size_t light : lights) {
            selected.radiance.push_back(block.radianceOf(p)[light]);
            selected.saturated.push_back(block.saturatedOf(p)[light]);
        }
    }
    return selected;
}

void clipAt(const glm::vec3& end, Observations& block)
{
    for (size_t k = 0; k < block.radiance.size(); ++k) {
        block.saturated[k] |= glm::any(glm::greaterThanEqual(block.radiance[k], end)) ? 1 : 0;
    }
}

namespace {

constexpr size_t kMostSampledPixels = 4000;

} // namespace

PixelSample samplePixels(const std::vector<uint32_t>& pixels, int width)
{
    PixelSample sample{1, pixels};
    if (pixels.size() <= kMostSampledPixels || width <= 0) {
        return sample;
    }
    sample.spacing = static_cast<int>(
        std::ceil(std::sqrt(static_cast<double>(pixels.size()) / static_cast<double>(kMostSampledPixels))));
    const int squares = (width + sample.spacing - 1) / sample.spacing;
    std::map<int, std::pair<int, uint32_t>> nearest; // by square: distance to its middle, and the pixel
    for (const uint32_t pixel : pixels) {
        const int x = static_cast<int>(pixel) % width, y = static_cast<int>(pixel) / width,
                  dx = 2 * (x % sample.spacing) + 1 - sample.spacing,
                  dy = 2 * (y % sample.spacing) + 1 - sample.spacing;
        const std::pair<int, uint32_t> candidate{dx * dx + dy * dy, pixel};
        const auto [place, isNew] = nearest.insert({y / sample.spacing * squares + x / sample.spacing, candidate});
        place->second = isNew ? candidate : std::min(place->second, candidate);
    }
    sample.pixels.clear();
    for (const auto& [square, best] : nearest) {
        sample.pixels.push_back(best.second);
    }
    std::sort(sample.pixels.begin(), sample.pixels.end());
    return sample;
}

void addToSample(const Observations& block, const PixelSample& chosen, Observations& sample)
{
    const size_t n = block.lightCount;
    sample.lightCount = n;
    sample.width = block.width;
    sample.spacing = chosen.spacing;
    auto next = chosen.pixels.begin();
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        next = std::lower_bound(next, chosen.pixels.end(), block.pixels[p]);
        if (next == chosen.pixels.end() || *next != block.pixels[p]) {
            continue;
        }
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
    addToSample(whole, samplePixels(whole.pixels, whole.width), sample);
    return sample;
}

} // namespace nacre
