#include "acquisition/self_light/self_light.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/self_light/arriving_light.h"
#include "acquisition/self_light/unlit_sides.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kPatchesAtOnce = 16, kPixelsAtOnce = 256;
// Light between the patches is worth a second estimate where it explains a tenth of what unlit sides show beside stray
// light, and where it is a hundredth of the brightness of the tenth of the pixels that get most: less is below what
// calibration errs.
constexpr double kLeastExplained = 0.1;
constexpr float kLeastShare = 0.01f;
constexpr double kMostLit = 0.9;
constexpr double kLargest = 0.99; // quantile, for the user

// One node for each square of the sample's spacing.
NormalMap latticeOf(const Observations& sample, const std::vector<PixelNormal>& normals)
{
    const uint32_t width = static_cast<uint32_t>(sample.width), spacing = static_cast<uint32_t>(sample.spacing);
    const uint32_t lowest = sample.pixels.back() / width;
    NormalMap lattice(static_cast<int>((width + spacing - 1) / spacing), static_cast<int>(lowest / spacing + 1));
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const uint32_t pixel = sample.pixels[p];
        const size_t node =
            lattice.index(static_cast<int>(pixel % width / spacing), static_cast<int>(pixel / width / spacing));
        lattice.normals[node] = normals[p].confidence > 0 ? normals[p].normal : glm::vec3(0);
        lattice.confidence[node] = normals[p].confidence;
    }
    return lattice;
}

// [patch * lights + light] mean radiance over irradiance of the patch's pixels.
std::vector<glm::vec3> patchPhotographs(const SelfLight& self, const Observations& sample,
                                        const std::vector<Light>& lights)
{
    const int side = self.spacing * kPatchSide;
    std::vector<glm::vec3> sums(self.grid.patches.size() * lights.size(), glm::vec3(0));
    std::vector<float> counts(self.grid.patches.size(), 0.0f);
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const int x = static_cast<int>(sample.pixels[p]) % sample.width,
                  y = static_cast<int>(sample.pixels[p]) / sample.width;
        const int patch = self.grid.index[static_cast<size_t>(y / side) * self.grid.width + x / side];
        if (patch < 0) {
            continue;
        }
        ++counts[patch];
        for (size_t i = 0; i < lights.size(); ++i) {
            sums[patch * lights.size() + i] += sample.radianceOf(p)[i] / lights[i].irradiance;
        }
    }
    for (size_t k = 0; k < sums.size(); ++k) {
        sums[k] /= std::max(1.0f, counts[k / lights.size()]);
    }
    return sums;
}

std::vector<glm::mat3> arrivingLight(const PatchGrid& grid, const std::vector<glm::vec3>& shown, size_t lightCount,
                                     int threads)
{
    const std::vector<std::vector<Passage>> passages = passagesBetween(grid, threads);
    std::vector<glm::mat3> arriving(shown.size(), glm::mat3(0));
    parallelFor(passages.size(), kPatchesAtOnce, threads, [&](size_t first, size_t last) {
        for (size_t to = first; to < last; ++to) {
            for (const Passage& passage : passages[to]) {
                for (size_t i = 0; i < lightCount; ++i) {
                    arriving[to * lightCount + i] +=
                        glm::outerProduct(passage.flow, shown[passage.from * lightCount + i]);
                }
            }
        }
    });
    return arriving;
}

SelfLitPixels selfLitPixels(const SelfLight& self, const Observations& sample, const std::vector<Light>& lights)
{
    const size_t n = lights.size();
    SelfLitPixels pixels{intensitiesOf(sample, lights), makeIntensities(sample.pixels.size(), n),
                         makeIntensities(sample.pixels.size(), n)};
    std::vector<glm::vec3> arriving;
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const Spot spot = spotOf(self, sample.pixels[p], sample.width);
        arrivingAt(self, spot, arriving);
        for (size_t i = 0; i < n; ++i) {
            pixels.arriving.values[p * pixels.arriving.stride + i] = greyOf(arriving[i]);
            pixels.cosines.values[p * pixels.cosines.stride + i] = glm::dot(spot.normal, lights[i].direction);
        }
    }
    return pixels;
}

// Per pixel, over all lights: light that arrives from the object over what the pixel shows.
std::vector<float> selfLitShares(const SelfLitPixels& pixels, float strength)
{
    std::vector<float> shares;
    for (size_t p = 0; p < pixels.seen.pixelCount(); ++p) {
        const auto seen = pixels.seen.ofPixel(p), arriving = pixels.arriving.ofPixel(p);
        const float albedo = selfLitAlbedo(seen, arriving, pixels.cosines.ofPixel(p), strength);
        float taken = 0, all = 0;
        for (size_t i = 0; i < seen.size(); ++i) {
            if (!isClipped(seen[i]) && seen[i] > 0) {
                taken += std::min(kMostSelfLight * seen[i], strength * albedo * arriving[i]);
                all += seen[i];
            }
        }
        shares.push_back(all > 0 ? taken / all : 0.0f);
    }
    return shares;
}

// One channel of one pixel under all lights.
struct Channel {
    std::vector<float> seen, arriving;

    explicit Channel(size_t lights) : seen(lights), arriving(lights) {}
};

void takeSelfLight(const SelfLight& self, const std::vector<Light>& lights, size_t pixel, const Spot& spot,
                   const std::vector<glm::vec3>& arriving, Observations& block)
{
    const size_t n = lights.size();
    std::vector<float> cosines(n);
    for (size_t i = 0; i < n; ++i) {
        cosines[i] = glm::dot(spot.normal, lights[i].direction);
    }
    const auto saturated = block.saturatedOf(pixel);
    Channel channel(n);
    for (int c = 0; c < 3; ++c) {
        for (size_t i = 0; i < n; ++i) {
            channel.seen[i] = saturated[i] ? kClipped : block.radiance[pixel * n + i][c] / lights[i].irradiance[c];
            channel.arriving[i] = arriving[i][c];
        }
        const float reflectance = self.strength * selfLitAlbedo(channel.seen, channel.arriving, cosines, self.strength);
        for (size_t i = 0; i < n; ++i) {
            float& radiance = block.radiance[pixel * n + i][c];
            radiance -= std::min(reflectance * arriving[i][c] * lights[i].irradiance[c],
                                 kMostSelfLight * std::max(radiance, 0.0f));
        }
    }
}

} // namespace

std::optional<SelfLight> findSelfLight(const Observations& sample, const std::vector<PixelNormal>& normals,
                                       const std::vector<Light>& lights, int threads)
{
    if (sample.pixels.empty() || sample.width <= 0) {
        return {};
    }
    SelfLight self;
    self.spacing = sample.spacing;
    self.lightCount = lights.size();
    self.normals = latticeOf(sample, normals);
    self.grid = makePatches(self.normals, threads);
    if (self.grid.patches.empty()) {
        return {};
    }
    self.arriving = arrivingLight(self.grid, patchPhotographs(self, sample, lights), lights.size(), threads);
    const SelfLitPixels pixels = selfLitPixels(self, sample, lights);
    const UnlitFit fit = fitUnlitSides(pixels);
    if (!fit.isSure || fit.explained < kLeastExplained) {
        return {};
    }
    self.strength = fit.strength;
    self.explained = fit.explained;
    std::vector<float> shares = selfLitShares(pixels, self.strength);
    self.largestShare = quantile(shares, kLargest);
    if (quantile(shares, kMostLit) < kLeastShare) {
        return {};
    }
    return self;
}

Observations withoutSelfLight(const SelfLight& self, Observations block, const std::vector<Light>& lights, int threads)
{
    parallelFor(block.pixels.size(), kPixelsAtOnce, threads, [&](size_t first, size_t last) {
        std::vector<glm::vec3> arriving;
        for (size_t p = first; p < last; ++p) {
            const Spot spot = spotOf(self, block.pixels[p], block.width);
            arrivingAt(self, spot, arriving);
            takeSelfLight(self, lights, p, spot, arriving, block);
        }
    });
    return block;
}

} // namespace nacre
