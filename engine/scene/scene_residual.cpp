#include "engine/scene/scene_residual.h"

#include <algorithm>

#include "engine/files/error.h"

namespace nacre {

bool hasResidualFrom(const Surface& surface, const glm::vec3& view)
{
    return !surface.residual.empty() && isFromTheFront(view);
}

void requireResidual(const Surface& surface, const glm::vec3& view, ResidualUse use)
{
    if (use != ResidualUse::alone || hasResidualFrom(surface, view)) {
        return;
    }
    if (surface.residual.empty()) {
        throw Error("", "--layer alone: what is drawn has no residual layer",
                    "a surface of nacre acquire --residual difference, on its own shape and in its own materials",
                    Error::kUsage);
    }
    throw Error("", "--layer alone: the residual layer is for the view from the front", "--view 0,0,1 or none",
                Error::kUsage);
}

size_t lightsBeyondResidual(const ResidualLayer& layer, std::span<const Light> lights)
{
    const ResidualLights captured(layer);
    return static_cast<size_t>(std::count_if(lights.begin(), lights.end(), [&](const Light& light) {
        return light.irradiance != glm::vec3(0) && captured.at(light.direction).presence < 1;
    }));
}

} // namespace nacre
