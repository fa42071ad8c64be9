#include "engine/gpu/ball_frame.h"

#include "ball_frag.h"
#include "shared/layout.h"

namespace nacre {

namespace {

constexpr std::array kBallBindings = {
    ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingInput, kTextureInput}, ResidualPass::kBindings[0], ResidualPass::kBindings[1]};
static_assert(kConstantModulated == 0 && kConstantToneCurve == 1 && kConstantBallResidual == 2);

} // namespace

BallFrame::BallFrame(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      pipelines_(context, {.fragmentShader = ball_frag,
                           .bindings = kBallBindings,
                           .pushConstantBytes = sizeof(BallConstants),
                           .targetFormat = kIntegersFormat}),
      target_(context)
{
}

void BallFrame::record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                       const Texture& codes)
{
    const Pipeline& fromBalls = pipelines_.with({pixels.albedo.bytes() > 0, inputs.toneCurve, inputs.residualFours});
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
