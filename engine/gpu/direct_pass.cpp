#include "engine/gpu/direct_pass.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "direct_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

// 256 bytes is the coarsest offset into a uniform buffer that a device may ask for.
static_assert(kLightsPerGroup * sizeof(LightFrame) % 256 == 0);
constexpr VkDeviceSize kGroupBytes = kLightsPerGroup * sizeof(LightFrame);

constexpr std::array<uint8_t, 1> kNoCodes = {0};
constexpr std::array kDirectBindings = {
    ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingTable, kTextureInput}, ShaderBinding{kBindingLights, kUniformInput},
    ShaderBinding{kBindingHorizon, kTextureInput}};
static_assert(kConstantLightCount == 0 && kConstantCoordinates == 1 && kConstantOneMaterial == 2 &&
              kConstantPacked == 3 && kConstantCoverage == 4 && kConstantShadows == 5);

// Those of the group that starts at `first`.
void fillHorizon(DirectConstants& constants, const LightGroups& lights, size_t first, size_t count, uint32_t azimuths)
{
    for (size_t i = 0; i < count; ++i) {
        constants.horizon[i] = horizonLookup(lights.direction(first + i), static_cast<int>(azimuths));
    }
}

} // namespace

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

DirectPass::DirectPass(const Context& context)
    : context_(context), pipelines_(context, {.fragmentShader = direct_frag,
                                              .bindings = kDirectBindings,
                                              .pushConstantBytes = sizeof(DirectConstants),
                                              .targetFormat = kFloatFormat,
                                              .blend = Blend::add}),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)), linear_(makeSampler(context, VK_FILTER_LINEAR)),
      noHorizon_(uploadLayers(context, {1, 1, 1}, 1, kNoCodes))
{
}

void DirectPass::record(VkCommandBuffer commands, const Inputs& inputs, const LightGroups& lights, size_t first,
                        size_t last)
{
    assert(first % kLightsPerGroup == 0);
    const VkExtent3D size = inputs.table.texture.extent();
    const TableDomain& domain = inputs.table.domain;
    DirectConstants constants{.view = glm::vec4(lights.view(), 0),
                              .tableSize = glm::vec4(size.width, size.height, size.depth, domain.thetaDMax),
                              .material = inputs.material,
                              .firstRow = inputs.firstRow,
                              .horizon = {}};
    const Texture& albedo = inputs.albedo ? *inputs.albedo : inputs.normals; // bound, but not read
    const Texture& horizon = inputs.horizon ? *inputs.horizon : noHorizon_;
    for (size_t light = first; light < last; light += kLightsPerGroup) {
        const auto count = static_cast<int>(std::min<size_t>(last - light, kLightsPerGroup));
        const std::array shaderInputs = {
            textureInput(kBindingNormals, nearest_, inputs.normals), textureInput(kBindingAlbedo, nearest_, albedo),
            textureInput(kBindingTable, linear_, inputs.table.texture), lights.group(light / kLightsPerGroup),
            textureInput(kBindingHorizon, nearest_, horizon)};
        if (inputs.horizon) {
            fillHorizon(constants, lights, light, static_cast<size_t>(count), horizon.layers());
        }
        const Pipeline& pipeline = pipelines_.with(
            {count, domain.coordinates, inputs.albedo == nullptr, inputs.normals.format() == kPackedNormalFormat,
             inputs.coverage && inputs.table.knowsCoverage, inputs.horizon != nullptr});
        draw(context_, commands, pipeline, shaderInputs, bytesOf(constants));
    }
}

} // namespace nacre
