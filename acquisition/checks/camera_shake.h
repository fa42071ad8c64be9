#pragma once
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "acquisition/capture/finding.h"
#include "acquisition/capture/observations.h"
#include "engine/lights/light.h"

namespace nacre {

// Where camera shake is looked for: squares of pixels all over an object and across its outline.
struct ShakeTiles {
    static constexpr int kSide = 40;
    std::vector<glm::ivec2> corners; // top left, pixels; every other one belongs to the second half
    // width x height, 1 in the tiles.
    std::vector<uint8_t> mask(int width, int height) const;
};

// None where the object is too small.
ShakeTiles shakeTiles(const std::vector<uint8_t>& mask, int width, int height);

// A warning where photographs are shifted against each other. Each is registered, by translation, to what Lambert's law
// makes of all, in either half of the tiles; what both halves agree on is camera shake. A shift that goes with the
// light's direction is left out: gloss and cast shadows make one, and no photograph can tell. `seen` has all pixels of
// the tiles.
SelfChecks checkShake(const Observations& seen, const ShakeTiles& tiles, const std::vector<Light>& lights, int threads);

} // namespace nacre
