#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "engine/lights/light.h"

namespace nacre {

// Lights [first, last) of a list.
struct LightRange {
    size_t first = 0;
    size_t last = 0;
    bool operator==(const LightRange&) const = default;
};

// While some lights of a list are moved, what the others add to a picture need not be drawn again. Tells them apart.
class MovingLights {
public:
    // The list in the order in which it is drawn: lights that stay, then those that have moved, which begin at a
    // multiple of kLightsPerGroup. Lights between the two ranges are drawn by nobody.
    struct Order {
        std::vector<Light> lights;
        LightRange still; // empty where none, or all of them, have moved
        LightRange moved;
    };

    // What has moved since forget(); nothing in the first list, nor in one of another length.
    Order follow(std::span<const Light> lights);
    void forget() { before_.clear(); }

private:
    std::vector<Light> before_;
    std::vector<uint8_t> hasMoved_;
};

} // namespace nacre
