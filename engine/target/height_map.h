#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "engine/surface/surface.h"

namespace nacre {

// A height in pixels of the map (1 channel, towards the viewer, NaN = no data) to its normals: central differences,
// one-sided beside what has no data. The surface holds the height as well, 0 where there is none.
Surface surfaceOfHeight(const Image& height);

// How high white lies above black: "12" or "12px" pixels, "5%" of the picture's width. Throws Error (usage).
struct HeightScale {
    float value = 0;
    bool ofWidth = false; // value is a share of the width
    float pixels(int width) const { return ofWidth ? value * static_cast<float>(width) : value; }
};
HeightScale heightScaleFromArgument(const std::string& text);

struct HeightMap {
    Image height;          // pixels, as surfaceOfHeight takes it
    float scale = 1;       // pixels that 1 in the file stands for
    bool eightBit = false; // 256 heights only: they show as terraces
};

// A picture with one channel, or with three alike. Float pictures hold pixels unless a scale is given; integers
// stand for kDefaultHeightOfWidth unless one is.
inline constexpr float kDefaultHeightOfWidth = 0.05f;
HeightMap loadHeightMap(const std::filesystem::path& file, const std::optional<HeightScale>& scale);

// One channel, or three that are alike everywhere.
bool isGrey(const Image& image);

} // namespace nacre
