#include "engine/gpu/light_groups.h"

#include <algorithm>

#include "shared/layout.h"

namespace nacre {

// 256 bytes is the coarsest offset into a uniform buffer that a device may ask for.
static_assert(kLightsPerGroup * sizeof(LightFrame) % 256 == 0);
constexpr VkDeviceSize kGroupBytes = kLightsPerGroup * sizeof(LightFrame);

void LightGroups::upload(const Context& context, std::span<const Light> lights, const glm::vec3& view)
{
    const size_t groups = std::max<size_t>(1, (lights.size() + kLightsPerGroup - 1) / kLightsPerGroup);
    if (buffer_.bytes() < groups * kGroupBytes) {
        buffer_ = Buffer(context, groups * kGroupBytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    }
    directions_.clear();
    for (const Light& light : lights) {
        directions_.push_back(light.direction);
    }
    view_ = view;
    std::transform(lights.begin(), lights.end(), static_cast<LightFrame*>(buffer_.mapped()),
                   [&](const Light& light) { return lightFrame(light.direction, view, light.irradiance); });
}

ShaderInput LightGroups::group(size_t index) const
{
    return uniformInput(kBindingLights, buffer_, index * kGroupBytes, kGroupBytes);
}

} // namespace nacre
