#include "app/materials/captured_photographs.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/capture/observations.h"
#include "acquisition/normals/normals.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/surface/surface.h"

namespace nacre {

namespace {

constexpr size_t kBlockBytes = size_t{32} << 20; // small enough that progress is seen
constexpr size_t kMostBytes = size_t{2} << 30;   // that a window may hold
constexpr size_t kPeakValues = 1 << 20;          // of all, evenly, for the percentile
constexpr size_t kJudgedAtOnce = 1024;           // pixels
constexpr float kReadingShare = 0.7f;            // of loading's time, roughly; the rest is judging

struct HeldCapture {
    Surface surface;
    Capture capture;
    Observations all;
    std::vector<uint8_t> verdicts;    // [pixel of all * captured lights + light], of kVerdictKinds
    std::vector<size_t> photographOf; // a captured light; the count of photographs where there is none
    double peak = 1;
};

void require(const HeldCapture& held, const std::filesystem::path& folder)
{
    const NormalMap& normals = held.surface.normals;
    if (held.capture.width != normals.width || held.capture.height != normals.height) {
        throw Error(folder, fmt::format("has photographs of {} x {} pixels", held.capture.width, held.capture.height),
                    fmt::format("{} x {} as the surface that was measured from them", normals.width, normals.height));
    }
    const size_t bytes = held.capture.maskPixels * held.capture.photographs.size() * sizeof(glm::vec3);
    if (bytes > kMostBytes) {
        throw Error(folder, fmt::format("takes {} MiB of memory", bytes >> 20),
                    fmt::format("at most {} MiB, with \"scale\" or \"crop\" in capture.json", kMostBytes >> 20));
    }
}

void append(Observations& all, const Observations& block)
{
    all.lightCount = block.lightCount;
    all.pixels.insert(all.pixels.end(), block.pixels.begin(), block.pixels.end());
    all.radiance.insert(all.radiance.end(), block.radiance.begin(), block.radiance.end());
    all.saturated.insert(all.saturated.end(), block.saturated.begin(), block.saturated.end());
}

std::vector<size_t> photographsOfLights(const Surface& surface, const Capture& capture,
                                        const std::filesystem::path& folder)
{
    std::vector<size_t> found;
    for (const CapturedLight& light : surface.lights) {
        const auto at = std::find_if(capture.photographs.begin(), capture.photographs.end(),
                                     [&](const Photograph& p) { return p.name == light.photograph; });
        found.push_back(static_cast<size_t>(at - capture.photographs.begin()));
    }
    if (std::find_if(found.begin(), found.end(), [&](size_t i) { return i < capture.photographs.size(); }) ==
        found.end()) {
        throw Error(folder, "has none of the photographs that the surface was measured from",
                    surface.lights.empty() ? "a surface with captured lights"
                                           : fmt::format("{} among them", surface.lights.front().photograph));
    }
    return found;
}

HeldCapture heldOf(const std::filesystem::path& capture, const std::filesystem::path& surface)
{
    HeldCapture held;
    held.surface = loadSurface(surface);
    CaptureOptions options; // as acquire read them
    if (!held.surface.transfer.empty()) {
        options.transfer = held.surface.transfer == "srgb" ? TransferCurve::srgb : TransferCurve::linear;
    }
    held.capture = loadCapture(capture, options);
    require(held, capture);
    held.photographOf = photographsOfLights(held.surface, held.capture, capture);
    return held;
}

Image pictureUnder(const HeldCapture& held, size_t light)
{
    Image picture(held.capture.width, held.capture.height, 3);
    const size_t photograph = held.photographOf.at(light);
    if (photograph >= held.all.lightCount) {
        return picture;
    }
    for (size_t p = 0; p < held.all.pixels.size(); ++p) {
        const glm::vec3& radiance = held.all.radianceOf(p)[photograph];
        for (size_t c = 0; c < 3; ++c) {
            picture.values[3 * held.all.pixels[p] + c] = radiance[static_cast<int>(c)];
        }
    }
    return picture;
}

// kVerdictKinds has a verdict's kinds in their order.
uint8_t kindOf(Verdict verdict)
{
    static_assert(static_cast<size_t>(Verdict::saturated) + 1 == kVerdictKinds.size());
    return static_cast<uint8_t>(verdict);
}

// What the photographs show of the p-th pixel that was read, judged by the surface's own model.
std::vector<PixelObservation> judged(const HeldCapture& held, size_t p)
{
    const Surface& surface = held.surface;
    const size_t pixel = held.all.pixels[p];
    const uint8_t label = surface.labels[pixel];
    if (label >= surface.materials.size()) {
        return {};
    }
    const glm::vec3& n = surface.normals.normals[pixel];
    glm::vec3 a(1);
    for (int c = 0; c < 3 && !surface.albedo.values.empty(); ++c) {
        a[c] = surface.albedo.values[3 * pixel + static_cast<size_t>(c)];
    }
    std::vector<PixelObservation> observations;
    std::vector<float> observed, predicted;
    for (size_t i = 0; i < surface.lights.size(); ++i) {
        if (held.photographOf[i] >= held.all.lightCount) {
            continue;
        }
        const Light& light = surface.lights[i].light;
        const float nDotL = glm::dot(n, light.direction);
        const glm::vec3 f = evaluateTable(surface.materials[label].table, n, light.direction, {0, 0, 1}).value;
        observed.push_back(greyOf(held.all.radianceOf(p)[held.photographOf[i]] / light.irradiance));
        predicted.push_back(nDotL > 0 ? greyOf(a * f) * nDotL : 0.0f);
        observations.push_back({i, nDotL, observed.back(), predicted.back(), 0});
    }
    std::vector<Verdict> verdicts(observations.size());
    judge(observed, predicted, verdicts);
    for (size_t i = 0; i < observations.size(); ++i) {
        const bool isSaturated = held.all.saturatedOf(p)[held.photographOf[observations[i].light]] != 0;
        observations[i].verdict = kindOf(isSaturated ? Verdict::saturated : verdicts[i]);
    }
    return observations;
}

std::vector<PixelObservation> observationsAt(const HeldCapture& held, size_t pixel)
{
    const std::vector<uint32_t>& pixels = held.all.pixels;
    const auto found = std::lower_bound(pixels.begin(), pixels.end(), pixel);
    const bool isThere = found != pixels.end() && *found == pixel;
    return isThere ? judged(held, static_cast<size_t>(found - pixels.begin())) : std::vector<PixelObservation>{};
}

// Verdicts on all of them: one needs its pixel's others, and stepping through photographs should not wait.
void judgeAll(HeldCapture& held, const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled)
{
    const size_t pixels = held.all.pixels.size(), lights = held.surface.lights.size();
    held.verdicts.assign(pixels * lights, kNotJudged);
    std::atomic<size_t> done = 0;
    parallelFor(pixels, kJudgedAtOnce, 0, [&](size_t first, size_t last) {
        for (size_t p = first; p < last && !isCancelled; ++p) {
            for (const PixelObservation& observation : judged(held, p)) {
                held.verdicts[p * lights + observation.light] = observation.verdict;
            }
        }
        done += last - first;
        progress(kReadingShare + (1 - kReadingShare) * static_cast<float>(done) / static_cast<float>(pixels));
    });
}

std::vector<uint8_t> verdictsUnder(const HeldCapture& held, size_t light)
{
    std::vector<uint8_t> verdicts(held.surface.labels.size(), kNotJudged);
    for (size_t p = 0; p < held.all.pixels.size(); ++p) {
        verdicts[held.all.pixels[p]] = held.verdicts[p * held.surface.lights.size() + light];
    }
    return verdicts;
}

void readAll(HeldCapture& held, const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled)
{
    held.all = {}; // what a cancelled reading left
    ObservationReader reader(held.capture, 0, kBlockBytes);
    for (Observations block; !isCancelled && reader.next(block);) {
        append(held.all, block);
        const auto share = static_cast<float>(held.all.pixels.size()) / static_cast<float>(held.capture.maskPixels);
        progress(kReadingShare * share);
    }
    held.peak = peakOf(held.all.radiance, kPeakValues);
    judgeAll(held, progress, isCancelled);
}

class CapturedPhotographs : public Photographs {
public:
    explicit CapturedPhotographs(HeldCapture held) : held_(std::move(held)) {}

    void load(const std::function<void(float)>& progress, const std::atomic<bool>& isCancelled) override
    {
        readAll(held_, progress, isCancelled);
    }
    glm::ivec2 size() const override { return {held_.capture.width, held_.capture.height}; }
    Image picture(size_t light) const override { return pictureUnder(held_, light); }
    std::vector<PixelObservation> observations(size_t pixel) const override { return observationsAt(held_, pixel); }
    std::vector<uint8_t> verdicts(size_t light) const override { return verdictsUnder(held_, light); }
    double peak() const override { return held_.peak; }

private:
    HeldCapture held_;
};

} // namespace

std::unique_ptr<Photographs> photographsOf(const std::filesystem::path& capture, const std::filesystem::path& surface)
{
    return std::make_unique<CapturedPhotographs>(heldOf(capture, surface));
}

} // namespace nacre
