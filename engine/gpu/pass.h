#pragma once
#include <span>

#include <vulkan/vulkan.h>

#include "engine/gpu/buffer.h"
#include "engine/gpu/context.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/texel_buffer.h"
#include "engine/gpu/texture.h"

namespace nacre {

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
