#include "engine/gpu/direct_pass.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "direct_frag.h"
#include "shared/layout.h"

namespace nacre {

DirectPass::DirectPass(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      linear_(makeSampler(context, VK_FILTER_LINEAR))
{
}

const Pipeline& DirectPass::pipeline(const Variant& variant)
{
    auto found = pipelines_.find(variant);
    if (found == pipelines_.end()) {
        static constexpr std::array kBindings = {
            ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
            ShaderBinding{kBindingTable, kTextureInput}, ShaderBinding{kBindingLights, kUniformInput}};
        static_assert(kConstantLightCount == 0 && kConstantCoordinates == 1 && kConstantOneMaterial == 2 &&
                      kConstantPacked == 3);
        const std::array constants = {variant.lightCount, variant.coordinates, variant.oneMaterial, variant.packed};
        found = pipelines_
                    .emplace(variant, Pipeline(context_, {.fragmentShader = direct_frag,
                                                          .constants = constants,
                                                          .bindings = kBindings,
                                                          .pushConstantBytes = sizeof(DirectConstants),
                                                          .targetFormat = kFloatFormat,
                                                          .blend = Blend::add}))
                    .first;
    }
    return found->second;
}

void DirectPass::record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first,
                        size_t last)
{
    assert(first % kLightsPerGroup == 0);
    const VkExtent3D size = inputs.table.texture.extent();
    const TableDomain& domain = inputs.table.domain;
    const DirectConstants constants{.view = glm::vec4(lights.view(), 0),
                                    .tableSize = glm::vec4(size.width, size.height, size.depth, domain.thetaDMax),
                                    .material = inputs.material};
    const Texture& albedo = inputs.albedo ? *inputs.albedo : inputs.normals; // bound, but not read
    for (size_t light = first; light < last; light += kLightsPerGroup) {
        const auto count = static_cast<int>(std::min<size_t>(last - light, kLightsPerGroup));
        const std::array shaderInputs = {
            textureInput(kBindingNormals, nearest_, inputs.normals), textureInput(kBindingAlbedo, nearest_, albedo),
            textureInput(kBindingTable, linear_, inputs.table.texture), lights.group(light / kLightsPerGroup)};
        const Variant variant{count, domain.coordinates, inputs.albedo == nullptr,
                              inputs.normals.format() == kPackedNormalFormat};
        draw(context_, commands, pipeline(variant), shaderInputs, bytesOf(constants));
    }
}

} // namespace nacre
