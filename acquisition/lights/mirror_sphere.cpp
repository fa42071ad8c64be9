#include "acquisition/lights/mirror_sphere.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/capture/exposure_merge.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

// Where the region above the threshold starts, between the sphere's median and its peak.
constexpr float kHighlightLevel = 0.5f;
// A distant light's mirror image is small; a larger region is shading or surroundings.
constexpr double kLargestShare = 0.1;
// The peak must stand out from the sphere's median by this many times the median's own spread.
constexpr float kLeastContrast = 10.0f;

bool inside(const Circle& c, int x, int y)
{
    return std::hypot(x + 0.5 - c.x, y + 0.5 - c.y) < c.radius - 0.5;
}

float brightness(const Image& image, int x, int y)
{
    return channelMean(image.rgb(x, y));
}

struct Region {
    double light = 0, sumX = 0, sumY = 0;
    size_t pixels = 0;
    bool cut = false; // touches the outline or the frame
};

struct Threshold {
    float base;  // median of the sphere
    float level; // where the highlight starts
    size_t spherePixels;
};

Threshold thresholdOf(const Image& image, const Circle& outline, const std::filesystem::path& source)
{
    std::vector<float> values;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (inside(outline, x, y)) {
                values.push_back(brightness(image, x, y));
            }
        }
    }
    const char* expected = "a photograph of the mirror sphere with one light's highlight";
    if (values.empty()) {
        throw Error(source, "shows nothing of the sphere", expected);
    }
    const size_t count = values.size();
    const float peak = *std::max_element(values.begin(), values.end());
    const float base = quantile(values, 0.5);
    const float spread = quantile(values, 0.9) - base;
    if (!(peak > 0) || peak - base < kLeastContrast * std::min(spread, base) || peak < 2 * base) {
        throw Error(source,
                    fmt::format("shows no highlight: its brightest value on the sphere is {:.3g}, its median {:.3g}",
                                peak, base),
                    expected);
    }
    return {base, base + kHighlightLevel * (peak - base), count};
}

void addLight(const Image& image, float base, int x, int y, Region& region)
{
    const double light = std::max(0.0f, brightness(image, x, y) - base);
    region.light += light;
    region.sumX += light * (x + 0.5);
    region.sumY += light * (y + 0.5);
}

// Flood fill of the 8-connected region above the level, with the ring of pixels around it, which the highlight
// covers in part: without them the centroid of a highlight of few pixels is off by a tenth of one.
Region growRegion(const Image& image, const Circle& outline, const Threshold& threshold, int startX, int startY,
                  std::vector<uint8_t>& seen)
{
    enum : uint8_t { kUnseen, kAbove, kRing };
    Region region;
    std::vector<std::pair<int, int>> open = {{startX, startY}}, ring;
    seen[static_cast<size_t>(startY) * image.width + startX] = kAbove;
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        addLight(image, threshold.base, x, y, region);
        ++region.pixels;
        for (int step = 0; step < 9; ++step) {
            const int nx = x + step % 3 - 1, ny = y + step / 3 - 1;
            if (nx < 0 || ny < 0 || nx >= image.width || ny >= image.height || !inside(outline, nx, ny)) {
                region.cut = true;
                continue;
            }
            uint8_t& mark = seen[static_cast<size_t>(ny) * image.width + nx];
            if (mark == kUnseen) {
                const bool above = brightness(image, nx, ny) >= threshold.level;
                mark = above ? kAbove : kRing;
                (above ? open : ring).emplace_back(nx, ny);
            }
        }
    }
    for (const auto& [x, y] : ring) {
        addLight(image, threshold.base, x, y, region);
        seen[static_cast<size_t>(y) * image.width + x] = kUnseen; // another region's ring may share it
    }
    return region;
}

Region brightestRegion(const Image& image, const Circle& outline, const Threshold& threshold)
{
    std::vector<uint8_t> seen(image.pixelCount(), 0);
    Region best;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (!seen[static_cast<size_t>(y) * image.width + x] && inside(outline, x, y) &&
                brightness(image, x, y) >= threshold.level) {
                const Region region = growRegion(image, outline, threshold, x, y, seen);
                if (region.light > best.light) {
                    best = region;
                }
            }
        }
    }
    return best;
}

} // namespace

Highlight findHighlight(const Image& photograph, const Circle& outline, const std::filesystem::path& source)
{
    const Threshold threshold = thresholdOf(photograph, outline, source);
    const Region region = brightestRegion(photograph, outline, threshold);
    const double share = static_cast<double>(region.pixels) / static_cast<double>(threshold.spherePixels);
    if (share > kLargestShare) {
        throw Error(source,
                    fmt::format("shows no highlight: its bright region covers {:.0f} % of the sphere", 100 * share),
                    "a mirror sphere, where a light's image is small");
    }
    if (region.cut) {
        throw Error(source,
                    fmt::format("its highlight, {:.0f}, {:.0f} from the middle, is cut by the sphere's outline or the "
                                "frame",
                                region.sumX / region.light - outline.x, region.sumY / region.light - outline.y),
                    "a highlight wholly inside both");
    }
    return {region.sumX / region.light, region.sumY / region.light, region.pixels};
}

glm::vec3 lightFromHighlight(const Highlight& highlight, const Circle& outline)
{
    const glm::vec3 n = sphereNormal(outline, highlight.x, highlight.y);
    return glm::normalize(glm::vec3(2 * n.x * n.z, 2 * n.y * n.z, 2 * n.z * n.z - 1));
}

} // namespace nacre
