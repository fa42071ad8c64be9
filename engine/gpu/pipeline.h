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

// A pass that covers the whole target with one triangle and adds what it writes to what is there.
struct PassDescription {
    std::span<const uint32_t> vertexShader; // SPIR-V
    std::span<const uint32_t> fragmentShader;
    std::span<const ShaderBinding> bindings; // of set 0, pushed, seen by the fragment shader
    uint32_t pushConstantBytes = 0;          // seen by the fragment shader
    VkFormat targetFormat = VK_FORMAT_UNDEFINED;
};

class Pipeline {
public:
    Pipeline(const Context& context, const PassDescription& pass);

    VkPipeline get() const { return pipeline_.get(); }
    VkPipelineLayout layout() const { return layout_.get(); }

private:
    Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> setLayout_;
    Owned<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
    Owned<VkPipeline, vkDestroyPipeline> pipeline_;
};

} // namespace nacre
