#include "app/materials/agreement.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/scene/reference.h"

namespace nacre {

Surface judgedSurface(const Surface& surface)
{
    constexpr int kSide = 192; // pixels
    return fittedSurface(surface, kSide, kSide);
}

std::vector<Light> judgedLights(const Surface& surface)
{
    constexpr size_t kMost = 6;
    std::vector<Light> lights;
    const size_t count = std::min(kMost, surface.lights.size());
    for (size_t i = 0; i < count; ++i) {
        lights.push_back(surface.lights[i * surface.lights.size() / count].light);
    }
    return lights.empty() ? std::vector<Light>{{glm::normalize(glm::vec3(-0.4f, 0.5f, 0.8f))}} : lights;
}

double agreementDecibels(const Surface& own, const std::function<Image(std::span<const Light>)>& picture)
{
    std::vector<uint8_t> mask;
    for (size_t i = 0; i < own.labels.size(); ++i) {
        mask.push_back(isShaded(own, i) ? 1 : 0);
    }
    Scene truth{own, {}};
    double squares = 0;
    const std::vector<Light> lights = judgedLights(own);
    for (const Light& light : lights) {
        truth.lights = {light};
        const Frame frame = renderReference(truth);
        squares += std::pow(10, -0.1 * radiancePsnr(picture(truth.lights), frame, mask, peakOf(frame, mask)));
    }
    return -10 * std::log10(std::max(squares / static_cast<double>(lights.size()), 1e-12));
}

} // namespace nacre
