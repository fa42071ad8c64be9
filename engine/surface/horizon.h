#pragma once
#include <cstdint>
#include <vector>

#include "engine/files/image.h"
#include "engine/surface/normal_map.h"
#include "shared/horizon.h"

namespace nacre {

inline constexpr int kHorizonAzimuths = 32;

// Per pixel and azimuth the elevation above which nothing of the height stands, coded as shaders/shared/horizon.h has
// it.
struct HorizonMap {
    int width = 0;
    int height = 0;
    int azimuths = 0;           // 0: not known, nothing casts a shadow
    std::vector<uint8_t> codes; // one picture an azimuth, from +x to +y, row 0 on top

    HorizonMap() = default;
    HorizonMap(int w, int h, int count)
        : width(w), height(h), azimuths(count), codes(static_cast<size_t>(w) * h * count, 0)
    {
    }
    bool empty() const { return azimuths == 0; }
    size_t pixelCount() const { return static_cast<size_t>(width) * height; }
    uint8_t& at(int azimuth, size_t pixel) { return codes[azimuth * pixelCount() + pixel]; }
    uint8_t at(int azimuth, size_t pixel) const { return codes[azimuth * pixelCount() + pixel]; }
};

// Of heights in pixels of the map. Pixels without a normal neither cast nor receive; what the picture does not show
// casts nothing.
HorizonMap horizonMap(const NormalMap& normals, const Image& height, int azimuths = kHorizonAzimuths, int threads = 0);

// Share of a light's radiance that reaches the pixel; 1 where the map is empty. `lookup` is horizonLookup of the light.
float visibilityOf(const HorizonMap& map, const glm::vec4& lookup, size_t pixel);

// The map of pixels picked one by one: pixel i of the answer is `from[i]`, negative ones see the whole sky.
HorizonMap pickedHorizon(const HorizonMap& map, const std::vector<int64_t>& from, int width, int height);

} // namespace nacre
