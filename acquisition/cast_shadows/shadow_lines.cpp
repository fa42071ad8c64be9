#include "acquisition/cast_shadows/shadow_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace nacre {

namespace {

// A light within 6 degrees of the camera casts no shadow that is longer than its error.
constexpr float kLeastSlant = 0.1f;
constexpr double kHeightTolerance = 0.5; // pixels of height: the grid knows no better

constexpr uint32_t kNone = UINT32_MAX;

// A line across the picture.
struct PixelLine {
    std::vector<uint32_t> pixels; // from the light's side, one a step; kNone where there is no normal
    float stepLength = 1;         // in pixels
};

uint32_t pixelAt(const NormalMap& normals, int x, int y)
{
    const size_t pixel = normals.index(x, y);
    return normals.confidence[pixel] > 0 ? static_cast<uint32_t>(pixel) : kNone;
}

// Lines along the light's way where it comes from one side: one pixel a step along the axis nearer to it; each pixel is
// of one.
template <class Visit> void forEachParallel(const NormalMap& normals, const glm::vec4& light, Visit&& visit)
{
    const glm::vec2 towards(light.x, -light.y); // columns and rows
    const bool isFlat = std::abs(towards.x) >= std::abs(towards.y);
    const float along = isFlat ? towards.x : towards.y, across = isFlat ? towards.y : towards.x;
    const float drift = across / along;
    std::vector<int> alongs, acrosses; // by step
    const int length = isFlat ? normals.width : normals.height, breadth = isFlat ? normals.height : normals.width;
    for (int step = 0; step < length; ++step) {
        const int place = along > 0 ? length - 1 - step : step;
        alongs.push_back(place);
        acrosses.push_back(static_cast<int>(std::lround(drift * static_cast<float>(place))));
    }
    const auto [least, most] = std::minmax(acrosses.front(), acrosses.back());
    PixelLine line{std::vector<uint32_t>(alongs.size()), std::sqrt(1 + drift * drift)};
    for (int start = -most; start < breadth - least; ++start) {
        bool isEmpty = true;
        for (size_t step = 0; step < line.pixels.size(); ++step) {
            const int at = start + acrosses[step];
            const bool isInside = at >= 0 && at < breadth;
            line.pixels[step] = !isInside ? kNone
                                : isFlat  ? pixelAt(normals, alongs[step], at)
                                          : pixelAt(normals, at, alongs[step]);
            isEmpty = isEmpty && line.pixels[step] == kNone;
        }
        if (!isEmpty) {
            visit(line);
        }
    }
}

// Lines through the point over which the light stands in the picture, to each pixel of its border. Where w is negative
// the light is seen in the direction away from there.
template <class Visit> void forEachRadial(const NormalMap& normals, const glm::vec4& light, Visit&& visit)
{
    const glm::dvec2 foot(light.x / light.w, -light.y / light.w); // columns and rows
    PixelLine line;
    const auto visitTo = [&](int x, int y) {
        const glm::dvec2 towards = foot - glm::dvec2(x, y);
        const double reach = std::max(std::abs(towards.x), std::abs(towards.y));
        if (reach < 1) {
            return;
        }
        const glm::dvec2 step = towards / reach;
        line.stepLength = static_cast<float>(glm::length(step));
        line.pixels.clear();
        for (int k = 0; k <= static_cast<int>(reach); ++k) {
            const auto column = static_cast<int>(std::lround(x + k * step.x)),
                       row = static_cast<int>(std::lround(y + k * step.y));
            if (column < 0 || row < 0 || column >= normals.width || row >= normals.height) {
                break;
            }
            line.pixels.push_back(pixelAt(normals, column, row));
        }
        if (light.w > 0) {
            std::reverse(line.pixels.begin(), line.pixels.end());
        }
        visit(line);
    };
    for (int x = 0; x < normals.width; ++x) {
        visitTo(x, 0);
        visitTo(x, normals.height - 1);
    }
    for (int y = 1; y + 1 < normals.height; ++y) {
        visitTo(0, y);
        visitTo(normals.width - 1, y);
    }
}

// The lines of a light, and how steeply it comes down along them.
class LightLines {
public:
    LightLines(const LitGrid& grid, size_t light)
        : grid_(grid), light_(grid.lights[light]), told_(light_.w == 0 ? 0 : grid.normals.normals.size(), 0)
    {
    }

    template <class Visit> void forEach(Visit&& visit) const
    {
        if (light_.w != 0) {
            forEachRadial(grid_.normals, light_, visit);
        } else if (std::hypot(light_.x, light_.y) > kLeastSlant) {
            forEachParallel(grid_.normals, light_, visit);
        }
    }

    // Of a ray to a pixel of the scene's height z over a step, in pixels. None where the pixel has been asked before,
    // or the light is too near to the camera.
    std::optional<float> risePerStep(const PixelLine& line, uint32_t pixel, double z)
    {
        const auto width = static_cast<uint32_t>(grid_.normals.width);
        const uint32_t column = pixel % width, row = pixel / width;
        const glm::vec3 p(column, -static_cast<float>(row), z);
        const glm::vec3 towards = glm::vec3(light_) - light_.w * p;
        const float across = glm::length(glm::vec2(towards));
        if (light_.w != 0) {
            if (told_[pixel] != 0 || across <= kLeastSlant * glm::length(towards)) {
                return std::nullopt;
            }
            told_[pixel] = 1;
        }
        return towards.z / across * line.stepLength;
    }

private:
    const LitGrid& grid_;
    glm::vec4 light_;
    std::vector<uint8_t> told_; // of lines that meet
};

// By what q rises along a ray that rises so much in the scene, to a pixel of the height q.
float riseOfNormals(const LitGrid& grid, double q, double rise)
{
    return static_cast<float>(std::isfinite(grid.cameraDistance) ? normalsHeight(grid, sceneHeight(grid, q) + rise) - q
                                                                 : rise);
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

std::vector<GrazingRay> shadowRays(const LitGrid& grid, size_t light, const std::vector<double>& height)
{
    std::vector<GrazingRay> rays;
    LightLines lines(grid, light);
    const auto isLit = [&](uint32_t pixel) { return pixel != kNone && grid.state(pixel, light) == LightState::lit; };
    lines.forEach([&](const PixelLine& line) {
        const std::vector<uint32_t>& pixels = line.pixels;
        size_t caster = pixels.size(); // the step of the last lit pixel
        for (size_t step = 0; step < pixels.size(); ++step) {
            const uint32_t pixel = pixels[step];
            if (isLit(pixel)) {
                caster = step;
            } else if (caster + 1 < step && pixel != kNone && grid.state(pixel, light) == LightState::cast) {
                const bool isEdge = step + 1 < pixels.size() && isLit(pixels[step + 1]);
                const double q = height[pixel];
                // What casts it ends somewhere before the next pixel.
                if (const auto rise = lines.risePerStep(line, pixel, sceneHeight(grid, q))) {
                    const float steps = static_cast<float>(step - caster) - 0.5f;
                    rays.push_back({pixels[caster], pixel, riseOfNormals(grid, q, *rise * steps), isEdge});
                }
            }
        }
    });
    return rays;
}

std::vector<GrazingRay> contradictedRays(const LitGrid& grid, size_t light, const std::vector<double>& height)
{
    std::vector<GrazingRay> rays;
    LightLines lines(grid, light);
    std::vector<Passed> hull; // upper and convex, the nearest last
    lines.forEach([&](const PixelLine& line) {
        hull.clear();
        for (size_t step = 0; step < line.pixels.size(); ++step) {
            if (line.pixels[step] == kNone) {
                continue;
            }
            const double q = height[line.pixels[step]];
            const Passed now{static_cast<double>(step), sceneHeight(grid, q), line.pixels[step]};
            while (hull.size() > 1 && !standsOver(hull.back(), hull[hull.size() - 2], now)) {
                hull.pop_back();
            }
            if (!hull.empty() && grid.state(now.pixel, light) == LightState::lit) {
                const auto perStep = lines.risePerStep(line, now.pixel, now.height);
                const double rise = perStep ? *perStep * (now.step - hull.back().step) : 0;
                if (perStep && hull.back().height - now.height > rise + kHeightTolerance) {
                    rays.push_back({hull.back().pixel, now.pixel, riseOfNormals(grid, q, rise)});
                }
            }
            hull.push_back(now);
        }
    });
    return rays;
}

} // namespace nacre
