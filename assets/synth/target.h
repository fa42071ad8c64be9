#pragma once
#include <cstdint>
#include <string>
#include <vector>

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

} // namespace nacre
