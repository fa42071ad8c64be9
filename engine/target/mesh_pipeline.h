#pragma once
#include <cstddef>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vulkan/vulkan.h>

#include "engine/gpu/context.h"
#include "engine/gpu/owned.h"
#include "engine/gpu/texture.h"

namespace nacre {

// One corner of a triangle as shaders/mesh_view.vert reads it.
struct MeshVertex {
    glm::vec3 point;
    glm::vec3 normal;
    glm::vec4 tangent;
    glm::vec2 uv;
};

// Depth in 32-bit floats, for one target.
class DepthBuffer {
public:
    DepthBuffer(const Context& context, VkExtent3D extent);
    VkImage image() const { return image_.get(); }
    VkImageView view() const { return view_.get(); }

private:
    Owned<VkDeviceMemory, vkFreeMemory> memory_; // freed after the image and its view
    Owned<VkImage, vkDestroyImage> image_;
    Owned<VkImageView, vkDestroyImageView> view_;
};

// Draws triangles of MeshVertex with shaders/mesh_view.{vert,frag}: both sides, the nearest wins.
class MeshPipeline {
public:
    MeshPipeline(const Context& context, bool mapped);
    VkPipeline get() const { return pipeline_.get(); }
    VkPipelineLayout layout() const { return layout_.get(); }

private:
    Owned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> setLayout_;
    Owned<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
    Owned<VkPipeline, vkDestroyPipeline> pipeline_;
};

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;
inline constexpr VkShaderStageFlags kMeshStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

} // namespace nacre
