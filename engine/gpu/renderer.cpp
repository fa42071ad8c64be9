#include "engine/gpu/renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include <fmt/format.h>

#include "ball_frag.h"
#include "display_frag.h"
#include "engine/scene/error.h"
#include "shared/layout.h"

namespace nacre {
namespace {

bool isFromTheFront(const glm::vec3& view)
{
    return view == glm::vec3(0, 0, 1);
}

constexpr std::array kBallBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                      ShaderBinding{kBindingAlbedo, kTextureInput},
                                      ShaderBinding{kBindingInput, kTextureInput}};
constexpr std::array kDisplayBindings = {ShaderBinding{kBindingInput, kTextureInput}};

} // namespace

Renderer::Renderer(const Context& context, VkDeviceSize cacheBytes)
    : context_(context), nearest_(makeSampler(context, VK_FILTER_NEAREST)), direct_(context),
      balls_(context, direct_, cacheBytes), cacheBytes_(cacheBytes)
{
}

void Renderer::setSurface(Surface surface)
{
    requirePictureSize(context_, surface.normals.width, surface.normals.height);
    tables_.clear();
    for (const Material& material : surface.materials) {
        tables_.push_back(uploadTable(context_, material.table));
    }
    surface_ = std::move(surface);
    plain_ = isPlain(surface_);
    pixels_.clear();
    ballSizes_.clear();
    radiance_.reset();
    picture_.reset();
    ballsAreStale_ = radianceIsStale_ = pictureIsStale_ = true;
}

void Renderer::setLights(std::span<const Light> lights)
{
    if (!std::equal(lights.begin(), lights.end(), lights_.begin(), lights_.end())) {
        lights_.assign(lights.begin(), lights.end());
        lightsAreStale_ = radianceIsStale_ = pictureIsStale_ = true;
    }
}

void Renderer::setView(const glm::vec3& view)
{
    if (view != view_) {
        view_ = view;
        lightsAreStale_ = radianceIsStale_ = pictureIsStale_ = true;
    }
}

void Renderer::setPath(RenderPath path)
{
    pictureIsStale_ = pictureIsStale_ || path != path_;
    path_ = path;
}

void Renderer::setDisplay(const Display& display)
{
    pictureIsStale_ = pictureIsStale_ || !(display == display_);
    display_ = display;
}

const std::vector<BallSize>& Renderer::ballSizes()
{
    while (ballSizes_.size() < surface_.materials.size()) {
        ballSizes_.push_back(measuredBallSize(surface_.materials[ballSizes_.size()].table));
    }
    return ballSizes_;
}

std::string Renderer::whyDirect()
{
    if (!isFromTheFront(view_)) {
        return "balls are for the view from the front";
    }
    for (size_t i = 0; i < ballSizes().size(); ++i) {
        if (ballSizes()[i].radiance == 0) {
            return fmt::format("the highlight of '{}' is too sharp for a ball", surface_.materials[i].name);
        }
    }
    const VkDeviceSize bytes = BallCache::leastBytes(ballSizes(), !plain_, lights_.size());
    if (surface_.materials.empty() || bytes > cacheBytes_) {
        return fmt::format("the balls of {} material(s) take {} MiB, {} may be cached", surface_.materials.size(),
                           bytes >> 20, cacheBytes_ >> 20);
    }
    return {};
}

RenderPath Renderer::pathTaken()
{
    if (path_ == RenderPath::direct) {
        return RenderPath::direct;
    }
    const std::string reason = whyDirect();
    if (path_ == RenderPath::ball && !reason.empty()) {
        throw Error("", "there is no ball for this: " + reason, "--path auto or --path direct", Error::kUsage);
    }
    return reason.empty() ? RenderPath::ball : RenderPath::direct;
}

const PixelTextures& Renderer::pixels(Precision precision)
{
    auto found = pixels_.find(precision);
    if (found == pixels_.end()) {
        found = pixels_.emplace(precision, uploadPixels(context_, surface_, precision)).first;
    }
    return found->second;
}

Renderer::Target& Renderer::target(std::optional<Target>& target, VkFormat format, VkDeviceSize texelBytes)
{
    if (!target) {
        const VkExtent3D extent{static_cast<uint32_t>(surface_.normals.width),
                                static_cast<uint32_t>(surface_.normals.height), 1};
        target.emplace(Target{makeTarget(context_, extent, format),
                              Buffer(context_, VkDeviceSize{extent.width} * extent.height * texelBytes,
                                     VK_BUFFER_USAGE_TRANSFER_DST_BIT)});
    }
    return *target;
}

void Renderer::uploadLights()
{
    if (lightsAreStale_) {
        groups_.upload(context_, lights_, view_);
        lightsAreStale_ = false;
    }
}

// One draw per material and group of lights; what they write adds up.
void Renderer::recordDirect(VkCommandBuffer commands, const Texture& into, const PixelTextures& pixels)
{
    imageBarrier(commands, into.image(), kDiscarded, kDrawnTo);
    beginRendering(commands, into, Load::clear);
    for (size_t material = 0; material < tables_.size(); ++material) {
        direct_.record(
            commands,
            {pixels.normals, plain_ ? nullptr : &pixels.albedo, tables_[material], static_cast<int>(material)}, groups_,
            0, lights_.size());
    }
    vkCmdEndRendering(commands);
}

const Pipeline& Renderer::framePipeline(RenderPath path)
{
    const bool ball = path == RenderPath::ball, modulated = ball && !plain_;
    const std::array key = {int{ball}, int{modulated}, display_.toneCurve};
    auto found = pipelines_.find(key);
    if (found == pipelines_.end()) {
        PassDescription pass{.fragmentShader = display_frag,
                             .bindings = kDisplayBindings,
                             .pushConstantBytes = sizeof(DisplayConstants),
                             .targetFormat = kCodeFormat};
        if (ball) {
            pass.fragmentShader = ball_frag;
            pass.bindings = kBallBindings;
            pass.pushConstantBytes = sizeof(BallConstants);
        }
        static_assert(kConstantModulated == 0 && kConstantToneCurve == 1);
        pass.constants = std::span(key).subspan(1);
        found = pipelines_.emplace(key, Pipeline(context_, pass)).first;
    }
    return found->second;
}

void Renderer::drawDirectPicture()
{
    Texture& codes = target(picture_, kCodeFormat, 4).texture;
    Texture& radiance = target(radiance_, kFloatFormat, sizeof(glm::vec4)).texture;
    const PixelTextures& inputs = pixels(Precision::compact);
    const Pipeline& encode = framePipeline(RenderPath::direct);
    context_.run([&](VkCommandBuffer commands) {
        recordDirect(commands, radiance, inputs);
        imageBarrier(commands, radiance.image(), kDrawnTo, kSampled);
        imageBarrier(commands, codes.image(), kDiscarded, kDrawnTo);
        beginRendering(commands, codes, Load::clear);
        const std::array shaderInputs = {textureInput(kBindingInput, nearest_, radiance)};
        draw(context_, commands, encode, shaderInputs,
             bytesOf(DisplayConstants{.gain = std::exp2(display_.exposureStops)}));
        vkCmdEndRendering(commands);
        imageBarrier(commands, codes.image(), kDrawnTo, kCopiedFrom);
    });
    radianceIsStale_ = true; // what the target holds is the picture's, from 16-bit inputs
}

void Renderer::updateBalls()
{
    if (pathTaken() != RenderPath::ball) {
        return;
    }
    uploadLights();
    if (ballsAreStale_) {
        balls_.setMaterials(ballSizes(), !plain_);
        ballsAreStale_ = false;
    }
    balls_.setLights(lights_);
    balls_.setDisplay(display_);
    if (balls_.prepare()) {
        context_.run([&](VkCommandBuffer commands) { balls_.record(commands, tables_, groups_); });
    }
}

void Renderer::drawBallPicture()
{
    updateBalls();
    Texture& codes = target(picture_, kCodeFormat, 4).texture;
    const PixelTextures& inputs = pixels(Precision::compact);
    const Texture& albedo = plain_ ? inputs.normals : inputs.albedo; // bound, but not read where plain
    const Pipeline& frame = framePipeline(RenderPath::ball);
    const BallConstants constants{.size = balls_.displaySize(),
                                  .columns = static_cast<float>(balls_.columns()),
                                  .materials = static_cast<int>(tables_.size())};
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, codes.image(), kDiscarded, kDrawnTo);
        beginRendering(commands, codes, Load::clear);
        const std::array shaderInputs = {textureInput(kBindingNormals, nearest_, inputs.normals),
                                         textureInput(kBindingAlbedo, nearest_, albedo),
                                         textureInput(kBindingInput, nearest_, balls_.displayBalls())};
        draw(context_, commands, frame, shaderInputs, bytesOf(constants));
        vkCmdEndRendering(commands);
        imageBarrier(commands, codes.image(), kDrawnTo, kCopiedFrom);
    });
}

void Renderer::drawPicture()
{
    if (!pictureIsStale_) {
        return;
    }
    uploadLights();
    if (pathTaken() == RenderPath::ball) {
        drawBallPicture();
    } else {
        drawDirectPicture();
    }
    pictureIsStale_ = false;
    ++drawnPictures_;
}

void Renderer::readBack(const Target& target)
{
    context_.run([&](VkCommandBuffer commands) {
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = target.texture.extent()};
        vkCmdCopyImageToBuffer(commands, target.texture.image(), kCopiedFrom.layout, target.readback.get(), 1, &copy);
        makeVisibleToHost(commands, target.readback);
    });
}

Image Renderer::picture()
{
    drawPicture();
    readBack(*picture_);
    Image picture(surface_.normals.width, surface_.normals.height, 3);
    const auto* codes = static_cast<const uint8_t*>(picture_->readback.mapped());
    for (size_t i = 0; i < picture.pixelCount(); ++i) {
        for (size_t c = 0; c < 3; ++c) {
            picture.values[3 * i + c] = static_cast<float>(codes[4 * i + c]) / 255.0f;
        }
    }
    return picture;
}

Frame Renderer::radiance()
{
    Target& into = target(radiance_, kFloatFormat, sizeof(glm::vec4));
    if (radianceIsStale_) {
        uploadLights();
        const PixelTextures& inputs = pixels(Precision::full);
        context_.run([&](VkCommandBuffer commands) {
            recordDirect(commands, into.texture, inputs);
            imageBarrier(commands, into.texture.image(), kDrawnTo, kCopiedFrom);
        });
        readBack(into);
        radianceIsStale_ = false;
    }
    Frame frame(surface_.normals.width, surface_.normals.height, 3);
    const auto* texels = static_cast<const glm::vec4*>(into.readback.mapped());
    for (size_t i = 0; i < frame.pixelCount(); ++i) {
        for (int c = 0; c < 3; ++c) {
            frame.values[3 * i + c] = texels[i][c];
        }
    }
    return frame;
}

Frame Renderer::render(std::span<const Light> lights, const glm::vec3& view)
{
    setLights(lights);
    setView(view);
    return radiance();
}

Frame Renderer::render(const Scene& scene)
{
    setSurface(scene.surface);
    return render(scene.lights, scene.view);
}

VkDeviceSize Renderer::deviceBytes() const
{
    VkDeviceSize bytes = balls_.bytes() + groups_.bytes();
    for (const TableTexture& table : tables_) {
        bytes += table.texture.bytes();
    }
    for (const auto& [precision, textures] : pixels_) {
        bytes += textures.bytes();
    }
    for (const auto* target : {&radiance_, &picture_}) {
        bytes += *target ? (*target)->texture.bytes() + (*target)->readback.bytes() : 0;
    }
    return bytes;
}

} // namespace nacre
