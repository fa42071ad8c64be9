#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// A surface to put materials onto, seen from the front by a distant camera.
struct Target {
    static constexpr uint8_t kNoPart = 255;

    NormalMap normals;           // confidence 0 beside the surface
    Image height;                // one channel, pixels towards the viewer; 0 beside the surface
    std::vector<uint8_t> labels; // per pixel: index into parts; kNoPart beside the surface
    std::vector<std::string> parts;

    Target() = default;
    Target(int width, int h, std::vector<std::string> names)
        : normals(width, h), height(width, h, 1), labels(normals.normals.size(), kNoPart), parts(std::move(names))
    {
    }
};

// A surface as a height over the picture's plane: the picture's shorter side spans [-1, 1], x right, y up, the
// picture's middle is the origin; heights in the same unit, towards the viewer.
struct ReliefPoint {
    double height;
    uint8_t part;
};
using Relief = std::function<ReliefPoint(const glm::dvec2&)>;

// A pixel's normal and height are means over its area and its label is the commonest part, so that a small picture is
// the large one filtered: no aliasing. The relief is to be continuous.
Target targetFromRelief(int width, int height, std::vector<std::string> parts, const Relief& relief, int threads);

// Distance between the samples that a picture is made of, in the plane's unit: detail finer than twice this is to be
// left out.
double reliefSpacing(int width, int height);

// How much of a detail is to be drawn whose period is `period`: all at four samples, nothing at two.
double detailShare(double period, double spacing);

} // namespace nacre
