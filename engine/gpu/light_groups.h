#pragma once
#include <span>
#include <vector>

#include "engine/gpu/pass.h"
#include "engine/lights/light.h"

namespace nacre {

// Lights as shaders read them, on the device, in groups of kLightsPerGroup.
class LightGroups {
public:
    // view is unit, towards the viewer for whom they are.
    void upload(const Context& context, std::span<const Light> lights, const glm::vec3& view);

    size_t lightCount() const { return directions_.size(); }
    const glm::vec3& direction(size_t light) const { return directions_[light]; }
    const glm::vec3& view() const { return view_; }
    ShaderInput group(size_t index) const;
    VkDeviceSize bytes() const { return buffer_.bytes(); }

private:
    Buffer buffer_;
    std::vector<glm::vec3> directions_;
    glm::vec3 view_{0, 0, 1};
};

} // namespace nacre
