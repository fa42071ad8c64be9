#pragma once
#include <span>
#include <vector>

#include "engine/gpu/pass.h"
#include "engine/gpu/surface_textures.h"
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

// Draws shaders/direct.frag: one material's radiance under a range of lights, added to the target, which has
// kFloatFormat and is being rendered to.
class DirectPass {
public:
    explicit DirectPass(const Context& context);

    struct Inputs {
        const Texture& normals;
        const Texture* albedo; // null: all pixels have the material, and albedo 1
        const TableTexture& table;
        int material;
        int firstRow = 0;      // of the surface, in the target's row 0
        bool coverage = false; // alpha counts what asks for unmeasured directions, where the table knows them
        const Texture* horizon = nullptr; // of the height that casts shadows; null: none does
    };
    // Lights [first, last) in order; first is a multiple of kLightsPerGroup.
    void record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first, size_t last);

private:
    const Context& context_;
    Pipelines pipelines_;
    Sampler nearest_;
    Sampler linear_;
    Texture noHorizon_; // bound where there are no shadows, but not read
};

} // namespace nacre
