#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <vulkan/vulkan.h>

#include "engine/gpu/buffer.h"
#include "engine/gpu/check.h"
#include "engine/gpu/context.h"
#include "engine/gpu/texture.h"

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

// The pipelines of one pass by its specialisation constants, made when first needed. What the description refers to has
// to stay.
class Pipelines {
public:
    Pipelines(const Context& context, const PassDescription& pass) : context_(context), pass_(pass) {}
    const Pipeline& with(std::vector<int32_t> constants);

private:
    const Context& context_;
    PassDescription pass_;
    std::map<std::vector<int32_t>, Pipeline> pipelines_;
};

// What a shader reads: a texture through a sampler, a part of a uniform buffer, or a buffer's texels.
struct ShaderInput {
    uint32_t binding = 0; // number in shaders/shared/layout.h
    VkDescriptorImageInfo image{};
    VkDescriptorBufferInfo buffer{};
    VkBufferView texels = VK_NULL_HANDLE;
};

ShaderInput textureInput(int binding, const Sampler& sampler, const Texture& texture);
ShaderInput uniformInput(int binding, const Buffer& buffer, VkDeviceSize offset, VkDeviceSize bytes);
ShaderInput texelInput(int binding, const TexelBuffer& texels);

inline constexpr VkDescriptorType kTextureInput = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
inline constexpr VkDescriptorType kUniformInput = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
inline constexpr VkDescriptorType kTexelInput = VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;

enum class Load { clear, keep }; // black and opaque, or what is there

// The target must be in kDrawnTo. `area` is where draws go, the whole target where it is empty.
void beginRendering(VkCommandBuffer commands, const Texture& target, Load load, VkRect2D area = {});

// Covers what the pipeline covers of the area. `constants` is the pipeline's push constant struct.
void draw(const Context& context, VkCommandBuffer commands, const Pipeline& pipeline,
          std::span<const ShaderInput> inputs, std::span<const std::byte> constants);

template <class Constants> std::span<const std::byte> bytesOf(const Constants& constants)
{
    static_assert(sizeof(Constants) <= 128, "push constants that every device has");
    return std::as_bytes(std::span(&constants, 1));
}

} // namespace nacre
