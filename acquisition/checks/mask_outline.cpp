#include "acquisition/checks/mask_outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr size_t kFewestPoints = 40; // of an outline
constexpr double kReach = 0.02; // of the object's size: outlines are drawn so well, and so far both sides are apart
constexpr double kElsewhere[] = {0.15, 0.25, 0.35}; // of the object's size
constexpr int kDirections = 12;
constexpr int kReachSteps = 2;             // of the reach, to either side
constexpr float kDarkSides = 0.01f;        // of the brightness of what is bright: no difference there
constexpr double kLargestElsewhere = 0.37; // by chance it is 0.5

struct OutlinePoint {
    glm::vec2 place; // pixels
    glm::vec2 outwards;
};

bool inside(const std::vector<uint8_t>& mask, int width, int x, int y)
{
    return mask[static_cast<size_t>(y) * width + x] != 0;
}

// Not at the picture's border, where masks are merely cut.
std::vector<OutlinePoint> outlineOf(const std::vector<uint8_t>& mask, int width, int height)
{
    constexpr int kAround = 3;
    std::vector<OutlinePoint> outline;
    for (int y = kAround; y + kAround < height; ++y) {
        for (int x = kAround; x + kAround < width; ++x) {
            if (!inside(mask, width, x, y) || (inside(mask, width, x - 1, y) && inside(mask, width, x + 1, y) &&
                                               inside(mask, width, x, y - 1) && inside(mask, width, x, y + 1))) {
                continue;
            }
            glm::vec2 outwards(0);
            for (int dy = -kAround; dy <= kAround; ++dy) {
                for (int dx = -kAround; dx <= kAround; ++dx) {
                    outwards += inside(mask, width, x + dx, y + dy) ? glm::vec2(0) : glm::vec2(dx, dy);
                }
            }
            if (glm::length(outwards) > 0) {
                outline.push_back({glm::vec2(x, y), glm::normalize(outwards)});
            }
        }
    }
    return outline;
}

class Outlines {
public:
    Outlines(const Observations& seen, double reach)
        : seen_(seen), height_(static_cast<int>(seen.pixels.size()) / seen.width), reach_(static_cast<float>(reach))
    {
        std::vector<float> brightness;
        for (size_t p = 0; p < seen.pixels.size(); ++p) {
            brightness.push_back(sizeOf(p));
        }
        least_ = kDarkSides * quantile(brightness, 0.9);
    }

    // How much both sides differ, 0 to 2: at the best place within reach. None where that leaves the picture.
    std::optional<float> differenceAt(const OutlinePoint& point) const
    {
        float most = 0;
        for (int step = -kReachSteps; step <= kReachSteps; ++step) {
            const glm::vec2 middle =
                point.place + point.outwards * (reach_ * static_cast<float>(step) / static_cast<float>(kReachSteps));
            const std::optional<size_t> a = pixelAt(middle - reach_ * point.outwards),
                                        b = pixelAt(middle + reach_ * point.outwards);
            if (!a || !b) {
                return std::nullopt;
            }
            most = std::max(most, difference(*a, *b));
        }
        return most;
    }

private:
    float sizeOf(size_t pixel) const
    {
        float sum = 0;
        for (const glm::vec3& value : seen_.radianceOf(pixel)) {
            sum += glm::dot(value, value);
        }
        return sum;
    }
    float difference(size_t a, size_t b) const
    {
        const auto one = seen_.radianceOf(a), other = seen_.radianceOf(b);
        float sum = 0;
        for (size_t i = 0; i < one.size(); ++i) {
            const glm::vec3 apart = one[i] - other[i];
            sum += glm::dot(apart, apart);
        }
        return sum / (sizeOf(a) + sizeOf(b) + least_);
    }
    std::optional<size_t> pixelAt(const glm::vec2& place) const
    {
        const int x = static_cast<int>(std::lround(place.x)), y = static_cast<int>(std::lround(place.y));
        if (x < 0 || y < 0 || x >= seen_.width || y >= height_) {
            return std::nullopt;
        }
        return static_cast<size_t>(y) * seen_.width + x;
    }

    const Observations& seen_;
    int height_;
    float reach_;
    float least_ = 0;
};

} // namespace

SelfChecks checkMaskOutline(const Observations& seen, const std::vector<uint8_t>& mask)
{
    const int height = static_cast<int>(seen.pixels.size()) / seen.width;
    const std::vector<OutlinePoint> outline = outlineOf(mask, seen.width, height);
    SelfChecks checks;
    if (outline.size() < kFewestPoints) {
        return checks;
    }
    const double size =
        std::sqrt(static_cast<double>(std::count_if(mask.begin(), mask.end(), [](uint8_t m) { return m != 0; })));
    const Outlines outlines(seen, std::max(1.5, kReach * size));
    double rank = 0, count = 0;
    for (const OutlinePoint& point : outline) {
        const std::optional<float> here = outlines.differenceAt(point);
        if (!here) {
            continue;
        }
        for (int k = 0; k < kDirections; ++k) {
            const double angle = 2 * std::numbers::pi * k / kDirections;
            for (const double away : kElsewhere) {
                const glm::vec2 moved = glm::vec2(std::cos(angle), std::sin(angle)) * static_cast<float>(away * size);
                if (const auto there = outlines.differenceAt({point.place + moved, point.outwards})) {
                    rank += *there > *here ? 1 : *there == *here ? 0.5 : 0;
                    ++count;
                }
            }
        }
    }
    if (count == 0) {
        return checks;
    }
    checks.judge(
        FindingCode::maskElsewhere, rank / count, kLargestElsewhere,
        fmt::format("the mask's outline follows no edge of the photographs (elsewhere in the picture it would "
                    "follow as much of one in {:.0f} % of places): another object's mask? That of a part of the "
                    "object has none either",
                    100 * rank / count));
    return checks;
}

} // namespace nacre
