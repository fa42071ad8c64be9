#include "engine/gpu/ball_frame.h"

#include "ball_frag.h"
#include "shared/layout.h"

namespace nacre {

BallFrame::BallFrame(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)), target_(context)
{
}

const Pipeline& BallFrame::pipeline(const PixelTextures& pixels, const Inputs& inputs)
{
    static_assert(kConstantModulated == 0 && kConstantToneCurve == 1 && kConstantBallResidual == 2);
    static constexpr std::array kBindings = {
        ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
        ShaderBinding{kBindingInput, kTextureInput}, ResidualPass::kBindings[0], ResidualPass::kBindings[1]};
    const std::array key = {int{pixels.albedo.bytes() > 0}, inputs.toneCurve, inputs.residualFours};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        found = pipelines_
                    .emplace(key, Pipeline(context_, {.fragmentShader = ball_frag,
                                                      .constants = key,
                                                      .bindings = kBindings,
                                                      .pushConstantBytes = sizeof(BallConstants),
                                                      .targetFormat = kIntegersFormat}))
                    .first;
    }
    return found->second;
}

void BallFrame::record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                       const Texture& codes)
{
    const Pipeline& fromBalls = pipeline(pixels, inputs);
    const std::array<ShaderInput, 2> layer = inputs.residual.inputs(pixels);
    const std::array shaderInputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                                     textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels)),
                                     textureInput(kBindingInput, nearest_, inputs.balls.displayBalls()), layer[0],
                                     layer[1]};
    target_.record(commands, codes, [&](int firstRow) {
        draw(context_, commands, fromBalls, shaderInputs,
             bytesOf(BallConstants{.size = inputs.balls.displaySize(),
                                   .columns = static_cast<float>(inputs.balls.columns()),
                                   .materials = inputs.materials,
                                   .firstRow = firstRow,
                                   .width = static_cast<int>(codes.extent().width)}));
    });
}

} // namespace nacre
