#pragma once
#include <string>
#include <vector>

#include "engine/lights/light.h"
#include "engine/scene/ball_size.h"
#include "engine/surface/surface.h"
#include "evaluation/charts/chart_svg.h"

namespace nacre {

// A path of the renderer: every pixel looks every light up in the table, or all lights in one ball of that size.
struct RenderingSetting {
    bool isBall = false;
    BallSize size; // of every material's ball; 0 texels: as the program measures it, material by material
    bool operator==(const RenderingSetting&) const = default;
};

struct RenderingRow {
    std::string capture;
    RenderingSetting setting;
    size_t lights = 0;
    double steadyMs = 0; // a frame, once everything is on the device
    double movedMs = 0;  // the first frame after every light has moved
    double psnr = 0;     // dB of the picture's codes against codes that nothing has rounded
    bool isDefault = false;
};

struct RenderingChoices {
    std::vector<RenderingSetting> settings{{},
                                           {true, {}},
                                           {true, {32, 64}},
                                           {true, {64, 128}},
                                           {true, {64, 320}},
                                           {true, {128, 512}},
                                           {true, {256, 1024}},
                                           {true, {512, 2048}}};
    std::vector<size_t> lights{1, 8, 64};
    int width = 1280, height = 720; // pixels of the frames
    int repeats = 9;                // at most, of which the median is told
};

// "direct", "ball 64/320": texels of radiance and as shown; "ball auto".
std::string describe(const RenderingSetting& setting);

// Lights before the surface, evenly over directions to 42 degrees off the view, each an equal part of one light.
// `turn` moves every one of them.
std::vector<Light> chartLights(size_t count, int turn);

// The object again and again, side by side, until it fills a picture of that size: frames of every capture then have
// the same number of pixels, and the captures' own mixture of normals, materials and albedo factors.
Surface tiledSurface(const Surface& surface, int width, int height);

// Frames against PSNR, each number of lights for itself: steady ones, and the first after a moved light.
Chart steadyFrameChart(const std::string& capture, const std::vector<RenderingRow>& rows);
Chart movedFrameChart(const std::string& capture, const std::vector<RenderingRow>& rows);

} // namespace nacre
