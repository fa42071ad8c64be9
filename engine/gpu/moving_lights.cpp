#include "engine/gpu/moving_lights.h"

#include "shared/layout.h"

namespace nacre {

MovingLights::Order MovingLights::follow(std::span<const Light> lights)
{
    if (before_.size() != lights.size()) {
        hasMoved_.assign(lights.size(), 0);
    } else {
        for (size_t i = 0; i < lights.size(); ++i) {
            hasMoved_[i] = hasMoved_[i] || !(lights[i] == before_[i]);
        }
    }
    before_.assign(lights.begin(), lights.end());

    Order order;
    const auto take = [&](bool moved) {
        for (size_t i = 0; i < lights.size(); ++i) {
            if ((hasMoved_[i] != 0) == moved) {
                order.lights.push_back(lights[i]);
            }
        }
    };
    take(false);
    const size_t still = order.lights.size();
    if (still == 0 || still == lights.size()) {
        return {.lights = before_, .still = {}, .moved = {0, lights.size()}};
    }
    order.lights.resize((still + kLightsPerGroup - 1) / kLightsPerGroup * kLightsPerGroup);
    order.still = {0, still};
    order.moved.first = order.lights.size();
    take(true);
    order.moved.last = order.lights.size();
    return order;
}

} // namespace nacre
