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
        throw Error("", "what is drawn has no residual layer to show alone",
                    "a surface that was acquired with one, on its own shape and in its own materials", Error::kUsage);
    }
    throw Error("", "the residual layer alone is for the view from the front", "the view 0,0,1 or none", Error::kUsage);
}

size_t lightsBeyondResidual(const ResidualLayer& layer, std::span<const Light> lights)
{
    const ResidualLights captured(layer);
    return static_cast<size_t>(std::count_if(lights.begin(), lights.end(), [&](const Light& light) {
        return light.irradiance != glm::vec3(0) && captured.at(light.direction).presence < 1;
    }));
}

} // namespace nacre
