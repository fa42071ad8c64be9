#include "acquisition/cast_shadows/shadow_lines.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace nacre {

namespace {

// A light within 6 degrees of the camera casts no shadow that is longer than its error.
constexpr float kLeastSlant = 0.1f;
constexpr double kHeightTolerance = 0.5; // pixels of height: the grid knows no better

constexpr uint32_t kNone = UINT32_MAX;

// Pixels of a line across the picture, from the light's side, kNone where there is no normal.
using PixelLine = std::vector<uint32_t>;

// Lines through the picture along the light's way, one pixel a step along the axis nearer to it; each pixel is of one.
class PixelLines {
public:
    PixelLines(const NormalMap& normals, const glm::vec3& light) : normals_(normals)
    {
        const glm::vec2 towards(light.x, -light.y); // columns and rows
        isFlat_ = std::abs(towards.x) >= std::abs(towards.y);
        const float along = isFlat_ ? towards.x : towards.y, across = isFlat_ ? towards.y : towards.x;
        const float drift = across / along;
        risePerStep = light.z / glm::length(towards) * std::sqrt(1 + drift * drift);
        const int length = isFlat_ ? normals.width : normals.height;
        for (int step = 0; step < length; ++step) {
            const int place = along > 0 ? length - 1 - step : step;
            along_.push_back(place);
            across_.push_back(static_cast<int>(std::lround(drift * static_cast<float>(place))));
        }
    }

    float risePerStep = 0; // of the ray, in pixels

    template <class Visit> void forEach(Visit&& visit) const
    {
        const int breadth = isFlat_ ? normals_.height : normals_.width;
        const auto [least, most] = std::minmax(across_.front(), across_.back());
        PixelLine line(along_.size());
        for (int start = -most; start < breadth - least; ++start) {
            bool isEmpty = true;
            for (size_t step = 0; step < line.size(); ++step) {
                const int across = start + across_[step];
                line[step] = across >= 0 && across < breadth ? pixelAt(along_[step], across) : kNone;
                isEmpty = isEmpty && line[step] == kNone;
            }
            if (!isEmpty) {
                visit(line);
            }
        }
    }

private:
    uint32_t pixelAt(int along, int across) const
    {
        const size_t pixel = isFlat_ ? normals_.index(along, across) : normals_.index(across, along);
        return normals_.confidence[pixel] > 0 ? static_cast<uint32_t>(pixel) : kNone;
    }

    const NormalMap& normals_;
    bool isFlat_ = true;
    std::vector<int> along_, across_; // by step
};

bool castsShadows(const glm::vec3& light)
{
    return std::hypot(light.x, light.y) > kLeastSlant;
}

// A place that a line has passed.
struct Passed {
    double step;
    double height;
    uint32_t pixel;
};

// Whether `near` hides `far`, both passed, from the place now.
bool standsOver(const Passed& near, const Passed& far, const Passed& now)
{
    return (near.height - now.height) * (now.step - far.step) > (far.height - now.height) * (now.step - near.step);
}

} // namespace

std::vector<GrazingRay> shadowRays(const LitGrid& grid, size_t light)
{
    std::vector<GrazingRay> rays;
    if (!castsShadows(grid.lights[light])) {
        return rays;
    }
    const PixelLines lines(grid.normals, grid.lights[light]);
    const auto isLit = [&](uint32_t pixel) { return pixel != kNone && grid.state(pixel, light) == LightState::lit; };
    lines.forEach([&](const PixelLine& line) {
        size_t caster = line.size(); // the step of the last lit pixel
        for (size_t step = 0; step < line.size(); ++step) {
            if (isLit(line[step])) {
                caster = step;
            } else if (caster + 1 < step && line[step] != kNone && grid.state(line[step], light) == LightState::cast) {
                const bool isEdge = step + 1 < line.size() && isLit(line[step + 1]);
                // What casts it ends somewhere before the next pixel.
                const float rise = lines.risePerStep * (static_cast<float>(step - caster) - 0.5f);
                rays.push_back({line[caster], line[step], rise, isEdge});
            }
        }
    });
    return rays;
}

std::vector<GrazingRay> contradictedRays(const LitGrid& grid, size_t light, const std::vector<double>& height)
{
    std::vector<GrazingRay> rays;
    if (!castsShadows(grid.lights[light])) {
        return rays;
    }
    const PixelLines lines(grid.normals, grid.lights[light]);
    std::vector<Passed> hull; // upper and convex, the nearest last
    lines.forEach([&](const PixelLine& line) {
        hull.clear();
        for (size_t step = 0; step < line.size(); ++step) {
            if (line[step] == kNone) {
                continue;
            }
            const Passed now{static_cast<double>(step), height[line[step]], line[step]};
            while (hull.size() > 1 && !standsOver(hull.back(), hull[hull.size() - 2], now)) {
                hull.pop_back();
            }
            if (!hull.empty() && grid.state(now.pixel, light) == LightState::lit) {
                const double rise = lines.risePerStep * (now.step - hull.back().step);
                if (hull.back().height - now.height > rise + kHeightTolerance) {
                    rays.push_back({hull.back().pixel, now.pixel, static_cast<float>(rise)});
                }
            }
            hull.push_back(now);
        }
    });
    return rays;
}

} // namespace nacre
