#include "evaluation/charts/rendering_chart.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
namespace nacre {

namespace {

struct Box {
    int left = 0, top = 0, width = 0, height = 0;
};

// Around the pixels that have a material; the whole picture where none has.
Box objectBox(const Surface& surface)
{
    const int width = surface.normals.width, height = surface.normals.height;
    int left = width, top = height, right = -1, bottom = -1;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (surface.labels[surface.normals.index(x, y)] != Surface::kNoMaterial) {
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
        }
    }
    return right < 0 ? Box{0, 0, width, height} : Box{left, top, right - left + 1, bottom - top + 1};
}

std::string seriesOf(size_t lights)
{
    return lights == 1 ? "1 light" : fmt::format("{} lights", lights);
}

Chart frameChart(const std::string& title, const std::string& axis, const std::vector<RenderingRow>& rows,
                 double RenderingRow::*milliseconds)
{
    Chart chart{title, {axis, true, true}, {"PSNR of the picture, dB", false, false}, {}, true};
    for (const RenderingRow& row : rows) {
        chart.points.push_back(
            {seriesOf(row.lights), describe(row.setting), row.*milliseconds, row.psnr, row.isDefault});
    }
    return chart;
}

} // namespace

std::string describe(const RenderingSetting& setting)
{
    return !setting.isBall            ? "direct"
           : setting.size.display > 0 ? fmt::format("ball {}/{}", setting.size.radiance, setting.size.display)
                                      : "ball auto";
}

std::vector<Light> chartLights(size_t count, int turn)
{
    constexpr float kGoldenAngle = 2.3999632f; // radians: neighbours in number are far apart in azimuth
    constexpr float kTurn = 0.01f, kSlope = 0.9f;
    std::vector<Light> lights;
    for (size_t i = 0; i < count; ++i) {
        const float number = static_cast<float>(i), share = (number + 0.5f) / static_cast<float>(count);
        const float azimuth = kGoldenAngle * number + kTurn * static_cast<float>(turn);
        const float slope = kSlope * std::sqrt(share);
        lights.push_back({glm::normalize(glm::vec3(slope * std::cos(azimuth), slope * std::sin(azimuth), 1)),
                          glm::vec3(1 / static_cast<float>(count))});
    }
    return lights;
}

Surface tiledSurface(const Surface& surface, int width, int height)
{
    const Box box = objectBox(surface);
    Surface tiled;
    tiled.normals = NormalMap(width, height);
    tiled.labels.resize(tiled.normals.normals.size());
    tiled.materials = surface.materials;
    const bool hasAlbedo = !surface.albedo.values.empty();
    if (hasAlbedo) {
        tiled.albedo = Image(width, height, 3);
    }
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int fromX = box.left + x % box.width, fromY = box.top + y % box.height;
            const size_t to = tiled.normals.index(x, y), from = surface.normals.index(fromX, fromY);
            tiled.normals.normals[to] = surface.normals.normals[from];
            tiled.normals.confidence[to] = surface.normals.confidence[from];
            tiled.labels[to] = surface.labels[from];
            if (hasAlbedo) {
                tiled.albedo.setRgb(x, y, surface.albedo.rgb(fromX, fromY));
            }
        }
    }
    return tiled;
}

Chart steadyFrameChart(const std::string& capture, const std::vector<RenderingRow>& rows)
{
    return frameChart(capture + ": rendering, a frame under lights that stand", "milliseconds a frame", rows,
                      &RenderingRow::steadyMs);
}

Chart movedFrameChart(const std::string& capture, const std::vector<RenderingRow>& rows)
{
    return frameChart(capture + ": rendering, the first frame after every light has moved", "milliseconds a frame",
                      rows, &RenderingRow::movedMs);
}

} // namespace nacre
