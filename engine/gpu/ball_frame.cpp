#include "engine/gpu/ball_frame.h"

#include "ball_frag.h"
#include "ball_residual_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

// Of shaders without a layer the first three.
constexpr std::array kBindings = {
    ShaderBinding{kBindingNormals, kTextureInput}, ShaderBinding{kBindingAlbedo, kTextureInput},
    ShaderBinding{kBindingInput, kTextureInput}, ResidualPass::kBindings[0], ResidualPass::kBindings[1]};
constexpr size_t kWithoutLayer = 3;

// Wide enough for whole rows.
VkExtent3D extentOfFours(VkExtent3D picture)
{
    return {(picture.width + kPixelsPerTexel - 1) / kPixelsPerTexel, picture.height, 1};
}

} // namespace

BallFrame::BallFrame(const Context& context) : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)) {}

void BallFrame::reset()
{
    fours_ = {};
    copied_ = {};
}

const Pipeline& BallFrame::pipeline(const PixelTextures& pixels, const Inputs& inputs)
{
    static_assert(kConstantModulated == 0 && kConstantToneCurve == 1 && kConstantBallResidual == 2);
    const std::array key = {int{pixels.albedo.bytes() > 0}, inputs.toneCurve,
                            inputs.residual ? pixels.residualFours : 0};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        PassDescription pass{.fragmentShader = ball_frag,
                             .constants = std::span(key).first(2),
                             .bindings = std::span(kBindings).first(kWithoutLayer),
                             .pushConstantBytes = sizeof(BallConstants),
                             .targetFormat = kCodeFormat};
        if (inputs.residual) {
            pass.fragmentShader = ball_residual_frag;
            pass.constants = key;
            pass.bindings = kBindings;
            pass.targetFormat = kIntegersFormat;
        }
        found = pipelines_.emplace(key, Pipeline(context_, pass)).first;
    }
    return found->second;
}

void BallFrame::recordDraw(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                           const Texture& target)
{
    std::vector<ShaderInput> shaderInputs = {textureInput(kBindingNormals, nearest_, pixels.normals),
                                             textureInput(kBindingAlbedo, nearest_, albedoOrAny(pixels)),
                                             textureInput(kBindingInput, nearest_, inputs.balls.displayBalls())};
    if (inputs.residual) {
        const std::array<ShaderInput, 2> layer = inputs.residual->inputs(pixels);
        shaderInputs.insert(shaderInputs.end(), layer.begin(), layer.end());
    }
    beginRendering(commands, target, Load::clear);
    draw(context_, commands, pipeline(pixels, inputs), shaderInputs,
         bytesOf(BallConstants{.size = inputs.balls.displaySize(),
                               .columns = static_cast<float>(inputs.balls.columns()),
                               .materials = inputs.materials,
                               .width = static_cast<int>(pixels.normals.extent().width)}));
    vkCmdEndRendering(commands);
}

// An image of four pixels a texel and one of a pixel a texel are the same bytes, but are only copied through a buffer.
void BallFrame::copyFours(VkCommandBuffer commands, const Texture& codes)
{
    const VkExtent3D extent = fours_.extent();
    const VkImageSubresourceLayers all{.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1};
    imageBarrier(commands, fours_.image(), kDrawnTo, kCopiedFrom);
    const VkBufferImageCopy out{.imageSubresource = all, .imageExtent = extent};
    vkCmdCopyImageToBuffer(commands, fours_.image(), kCopiedFrom.layout, copied_.get(), 1, &out);
    makeVisibleToDevice(commands, copied_);
    imageBarrier(commands, codes.image(), kDrawnTo, kCopiedTo);
    const VkBufferImageCopy in{
        .bufferRowLength = kPixelsPerTexel * extent.width, .imageSubresource = all, .imageExtent = codes.extent()};
    vkCmdCopyBufferToImage(commands, copied_.get(), codes.image(), kCopiedTo.layout, 1, &in);
    imageBarrier(commands, codes.image(), kCopiedTo, kDrawnTo);
}

void BallFrame::record(VkCommandBuffer commands, const PixelTextures& pixels, const Inputs& inputs,
                       const Texture& codes)
{
    if (!inputs.residual) {
        recordDraw(commands, pixels, inputs, codes);
        return;
    }
    if (fours_.bytes() == 0) {
        const VkExtent3D extent = extentOfFours(codes.extent());
        fours_ = makeTarget(context_, extent, kIntegersFormat);
        copied_ = Buffer(context_, VkDeviceSize{4} * kPixelsPerTexel * extent.width * extent.height,
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, Memory::device);
    }
    imageBarrier(commands, fours_.image(), kDiscarded, kDrawnTo);
    recordDraw(commands, pixels, inputs, fours_);
    copyFours(commands, codes);
}

} // namespace nacre
