#include "engine/gpu/ball_frame.h"

#include <array>

#include "ball_frag.h"
#include "ball_places_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr std::array kPlacesBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                        ShaderBinding{kBindingAlbedo, kTextureInput}};
constexpr std::array kBallBindings = {
    ShaderBinding{kBindingBallPlaces, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingInput, kTextureInput}, ResidualPass::kBindings[0], ResidualPass::kBindings[1]};
static_assert(kConstantModulated == 0 && kConstantToneCurve == 1 && kConstantBallResidual == 2);

} // namespace

BallFrame::BallFrame(const Context& context)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      placing_(context, {.fragmentShader = ball_places_frag,
                         .bindings = kPlacesBindings,
                         .pushConstantBytes = sizeof(BallPlacesConstants),
                         .targetFormat = kIntegersFormat}),
      pipelines_(context, {.fragmentShader = ball_frag,
                           .bindings = kBallBindings,
                           .pushConstantBytes = sizeof(BallConstants),
                           .targetFormat = kIntegersFormat}),
      target_(context)
{
}

void BallFrame::reset()
{
    dropPixels();
    places_ = {};
    target_.reset();
}

void BallFrame::recordPlaces(VkCommandBuffer commands, const PixelTextures& pixels, const Layout& layout)
{
    if (!placesAreStale_ && layout == layout_) {
        return;
    }
    placesAreStale_ = false;
    const VkExtent3D picture = pixels.normals.extent();
    if (places_.bytes() == 0) {
        places_ = makeTarget(context_, {(picture.width + kPixelsPerTexel - 1) / kPixelsPerTexel, picture.height, 1},
                             kIntegersFormat);
    }
    layout_ = layout;
    const std::array inputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                               textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels))};
    imageBarrier(commands, places_.image(), kDiscarded, kDrawnTo);
    beginRendering(commands, places_, Load::clear);
    draw(context_, commands, placing_.with({pixels.albedo.bytes() > 0}), inputs,
         bytesOf(BallPlacesConstants{.size = layout.size,
                                     .columns = layout.columns,
                                     .materials = layout.materials,
                                     .width = static_cast<int>(picture.width)}));
    vkCmdEndRendering(commands);
    imageBarrier(commands, places_.image(), kDrawnTo, kSampled);
}

void BallFrame::record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                       const Texture& codes)
{
    recordPlaces(commands, pixels, {inputs.balls.displaySize(), inputs.balls.columns(), inputs.materials});
    const Pipeline& fromBalls = pipelines_.with({pixels.albedo.bytes() > 0, inputs.toneCurve, inputs.residualFours});
    const std::array<ShaderInput, 2> layer = inputs.residual.inputs(pixels);
    const std::array shaderInputs = {textureInput(kBindingBallPlaces, nearest_, places_),
                                     textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels)),
                                     textureInput(kBindingInput, nearest_, inputs.balls.displayBalls()), layer[0],
                                     layer[1]};
    target_.record(commands, codes, pixels.shown, [&](int firstRow) {
        draw(context_, commands, fromBalls, shaderInputs,
             bytesOf(BallConstants{.firstRow = firstRow, .width = static_cast<int>(codes.extent().width)}));
    });
}

} // namespace nacre
