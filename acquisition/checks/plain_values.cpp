#include "acquisition/checks/plain_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr float kLittleBelow = 31.0f / 32; // of the largest value
constexpr size_t kFewestAtEnd = 20;
constexpr size_t kFewestPhotographs = 3; // a flat patch may have one value in one

constexpr double kBright = 0.9;     // quantile over the pixels of their brightest values
constexpr float kDark = 1.0f / 512; // of it: 8 bits do not show it beside it
// Where no mask was drawn: a background may have noise and stray light.
constexpr float kDarkUnmasked = 1.0f / 64;
constexpr double kLargestDark = 0.1; // of the mask
// An object that fills the picture has more of it than a hole.
constexpr double kLargestBorder = 0.95, kLeastLeftOut = 0.1;

// Of one channel: infinite where it only has a largest value.
float endOfChannel(const Observations& sample, int c)
{
    float largest = 0;
    for (size_t k = 0; k < sample.radiance.size(); ++k) {
        largest = sample.saturated[k] ? largest : std::max(largest, sample.radiance[k][c]);
    }
    size_t atEnd = 0, below = 0;
    std::vector<char> photographs(sample.lightCount);
    for (size_t k = 0; k < sample.radiance.size(); ++k) {
        const float value = sample.saturated[k] ? 0 : sample.radiance[k][c];
        if (value >= largest) {
            ++atEnd;
            photographs[k % sample.lightCount] = 1;
        } else {
            below += value > largest * kLittleBelow;
        }
    }
    const auto shown = static_cast<size_t>(std::count(photographs.begin(), photographs.end(), 1));
    const bool ends = largest > 0 && atEnd >= kFewestAtEnd && atEnd > below && shown >= kFewestPhotographs;
    return ends ? largest : std::numeric_limits<float>::infinity();
}

// Of what the lights ask for: the rest is light that is not theirs.
constexpr double kLeastDifference = 1.0 / 3;

struct Spread {
    double sum = 0, squares = 0, count = 0;

    void add(double value)
    {
        sum += value;
        squares += value * value;
        ++count;
    }
    double relative() const
    {
        const double mean = sum / count;
        return mean > 0 ? std::sqrt(std::max(0.0, squares / count - mean * mean)) / mean : 0;
    }
};

// Of the cosines on a surface that faces the middle of the lights.
double spreadOfCosines(const std::vector<Light>& lights)
{
    glm::vec3 middle(0);
    for (const Light& light : lights) {
        middle += light.direction;
    }
    Spread spread;
    for (const Light& light : lights) {
        spread.add(glm::dot(light.direction, middle));
    }
    return spread.relative();
}

} // namespace

std::optional<glm::vec3> endOfValues(const Observations& sample)
{
    const glm::vec3 end(endOfChannel(sample, 0), endOfChannel(sample, 1), endOfChannel(sample, 2));
    return std::isfinite(std::min({end.x, end.y, end.z})) ? std::optional(end) : std::nullopt;
}

SelfChecks checkMask(const Observations& sample, bool isMasked)
{
    std::vector<float> brightest;
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const auto seen = sample.radianceOf(p);
        brightest.push_back(std::accumulate(seen.begin(), seen.end(), 0.0f, [](float most, const glm::vec3& value) {
            return std::max(most, channelMean(value));
        }));
    }
    if (brightest.empty()) {
        return {};
    }
    const float level = (isMasked ? kDark : kDarkUnmasked) * quantile(brightest, kBright);
    const auto dark = std::count_if(brightest.begin(), brightest.end(), [&](float v) { return v < level; });
    const double share = static_cast<double>(dark) / static_cast<double>(brightest.size());
    const double percent = 100 * share;
    SelfChecks checks;
    checks.judge(
        FindingCode::maskDark, share, kLargestDark,
        isMasked ? fmt::format("{:.0f} % of the mask is dark under every light: the mask of something else, one "
                               "that is turned, or black and white exchanged",
                               percent)
                 : fmt::format("there is no mask, and {:.0f} % of the picture, all of which is taken for the object, "
                               "is dark under every light: draw one, white on the object, and name it by --mask",
                               percent));
    return checks;
}

SelfChecks checkMaskBorder(const std::vector<uint8_t>& mask, int width, int height)
{
    size_t border = 0, onBorder = 0, outside = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool inside = mask[static_cast<size_t>(y) * width + x] != 0;
            const bool isBorder = x == 0 || y == 0 || x + 1 == width || y + 1 == height;
            border += isBorder;
            onBorder += isBorder && inside;
            outside += !inside;
        }
    }
    const double left = static_cast<double>(outside) / static_cast<double>(mask.size());
    const double share = left > kLeastLeftOut ? static_cast<double>(onBorder) / static_cast<double>(border) : 0;
    SelfChecks checks;
    checks.judge(FindingCode::maskInverted, share, kLargestBorder,
                 fmt::format("the mask has {:.0f} % of the picture's border and leaves out {:.0f} % in the middle: are "
                             "black and white exchanged? White is the object",
                             100 * share, 100 * left));
    return checks;
}

SelfChecks checkDifferences(const Observations& sample, const std::vector<Light>& lights)
{
    std::vector<float> spreads;
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        Spread spread;
        for (size_t i = 0; i < lights.size(); ++i) {
            spread.add(channelMean(sample.radianceOf(p)[i] / lights[i].irradiance));
        }
        spreads.push_back(static_cast<float>(spread.relative()));
    }
    const double expected = spreadOfCosines(lights), seen = spreads.empty() ? expected : quantile(spreads, 0.5);
    SelfChecks checks;
    checks.judge(
        FindingCode::photographsAlike, std::max(0.0, 1 - seen / expected), 1 - kLeastDifference,
        fmt::format("the photographs hardly differ: pixels by {:.1f} %, where their lights make a surface that "
                    "faces them differ by {:.0f} %; darken the room, or check the files",
                    100 * seen, 100 * expected));
    return checks;
}

} // namespace nacre
