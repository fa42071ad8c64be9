#include "engine/viewer/thumbnails.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

#include "engine/gpu/renderer.h"

namespace nacre {

Image materialThumbnail(const Context& context, const Material& material, int size)
{
    Renderer renderer(context);
    renderer.setPath(RenderPath::direct); // one small picture is not worth measuring the ball's size
    renderer.setSurface(transferredSurface(sphereNormalMap(size), material));
    const std::array lights = {Light{.direction = glm::normalize(glm::vec3(-0.4f, 0.5f, 0.8f))}};
    renderer.setLights(lights);
    renderer.setDisplay({.exposureStops = renderer.automaticExposure()});
    return renderer.picture();
}

Surface ballSurface(const Surface& surface, int size)
{
    std::array<size_t, 256> counts{};
    for (const uint8_t label : surface.labels) {
        ++counts[label];
    }
    const auto end = counts.begin() + static_cast<std::ptrdiff_t>(surface.materials.size());
    const auto most = static_cast<size_t>(std::max_element(counts.begin(), end) - counts.begin());
    return transferredSurface(sphereNormalMap(size), surface.materials[most]);
}

} // namespace nacre
