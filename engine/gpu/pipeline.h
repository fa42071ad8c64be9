#pragma once
#include <cstdint>
#include <span>

#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"

namespace nacre {

struct ShaderBinding {
    uint32_t binding; // number in shaders/shared/layout.h
    VkDescriptorType type;
};

// What happens to what a target holds.
enum class Blend { replace, add };

// What a pass covers of its area: all of it, or the disc that fills it.
enum class Cover { area, disc };

// Triangles of one vertex buffer, seen from both sides; the nearest is kept.
struct VertexInput {
    std::span<const uint32_t> shader; // SPIR-V
    uint32_t stride = 0;              // bytes
    std::span<const VkVertexInputAttributeDescription> attributes;
    VkFormat depthFormat = VK_FORMAT_UNDEFINED;
};

// A pass; without vertices where it has no VertexInput.
struct PassDescription {
    std::span<const uint32_t> fragmentShader; // SPIR-V
    std::span<const int32_t> constants;       // specialisation constants 0, 1, ...
    std::span<const ShaderBinding> bindings;  // of set 0, pushed, seen by the fragment shader
    uint32_t pushConstantBytes = 0;           // seen by the fragment shader, and by that of vertices
    VkFormat targetFormat = VK_FORMAT_UNDEFINED;
    Blend blend = Blend::replace;
    Cover cover = Cover::area;
    const VertexInput* vertices = nullptr; // in place of cover
};

class Pipeline {
public:
    Pipeline() = default;
    Pipeline(const Context& context, const PassDescription& pass);

    VkPipeline get() const { return pipeline_.get(); }
    VkPipelineLayout layout() const { return layout_.get(); }
    VkShaderStageFlags constantStages() const { return constantStages_; } // that see the push constants
    uint32_t vertexCount() const { return vertexCount_; }                 // of a pass without VertexInput

private:
    Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> setLayout_;
    VkShaderStageFlags constantStages_ = VK_SHADER_STAGE_FRAGMENT_BIT;
    Owned<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
    Owned<VkPipeline, vkDestroyPipeline> pipeline_;
    uint32_t vertexCount_ = 0;
};

} // namespace nacre
