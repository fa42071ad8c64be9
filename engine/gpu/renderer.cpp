#include "engine/gpu/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/scene/scene_residual.h"
#include "engine/surface/object_places.h"
#include "engine/surface/surface.h"
#include "false_colour_frag.h"
#include "shared/layout.h"

namespace nacre {
namespace {

constexpr float kMiddleGrey = 0.2140f; // linear, of code 0.5: what a layer by itself is drawn about

constexpr std::array kFalseColourBindings = {ShaderBinding{kBindingNormals, kTextureInput},
                                             ShaderBinding{kBindingAlbedo, kTextureInput}};
static_assert(kConstantModulated == 0 && kConstantShow == 1);

bool dependsOnLights(Show show)
{
    return show != Show::normals && show != Show::labels;
}

bool dependsOnDisplay(Show show)
{
    return show == Show::picture || show == Show::coverage;
}

} // namespace

Renderer::Renderer(const Context& context, VkDeviceSize cacheBytes)
    : context_(context), direct_(context), residualPass_(context), balls_(context, direct_, cacheBytes),
      cacheBytes_(cacheBytes), ballFrame_(context), directFrame_(context, direct_), exposureFrame_(context, direct_),
      nearest_(makeSampler(context, VK_FILTER_NEAREST)),
      falseColours_(context, {.fragmentShader = false_colour_frag,
                              .bindings = kFalseColourBindings,
                              .pushConstantBytes = sizeof(FalseColourConstants),
                              .targetFormat = kCodeFormat})
{
}

// What was made of the surface's pixels.
void Renderer::dropPixels()
{
    pixels_.reset();
    exposurePixels_.reset();
    directFrame_.reset();
    exposureFrame_.reset();
}

void Renderer::setSurface(Surface surface, std::vector<BallSize> sizes)
{
    requirePictureSize(context_, surface.normals.width, surface.normals.height);
    tables_.clear();
    for (const Material& material : surface.materials) {
        tables_.push_back(uploadTable(context_, material.table));
    }
    surface_ = std::move(surface);
    plain_ = isPlain(surface_);
    dropPixels();
    ballFrame_.reset();
    ballSizes_ = std::move(sizes);
    lightsAreStale_ = true;
    radiance_.reset();
    picture_.reset();
    materialBall_.reset();
    ballsAreStale_ = pictureIsStale_ = true;
}

void Renderer::setPixels(const Surface& pixels)
{
    const bool isOtherSize =
        pixels.normals.width != surface_.normals.width || pixels.normals.height != surface_.normals.height;
    surface_.normals = pixels.normals;
    surface_.labels = pixels.labels;
    surface_.height = pixels.height;
    surface_.horizon = pixels.horizon;
    surface_.places = pixels.places;
    surface_.camera = pixels.camera;
    dropPixels();
    radiance_.reset();
    if (isOtherSize) {
        ballFrame_.reset();
        picture_.reset();
    }
    pictureIsStale_ = true;
}

void Renderer::materialBallHasChanged()
{
    if (materialBall_) {
        materialBall_->isStale = true;
    }
}

void Renderer::lightsHaveChanged()
{
    materialBallHasChanged();
    lightsAreStale_ = true;
    radiance_.reset();
    pictureIsStale_ = pictureIsStale_ || dependsOnLights(show_);
}

void Renderer::setLights(std::span<const Light> lights)
{
    if (!std::equal(lights.begin(), lights.end(), lights_.begin(), lights_.end())) {
        lights_.assign(lights.begin(), lights.end());
        lightsHaveChanged();
    }
}

void Renderer::setView(const glm::vec3& view)
{
    if (view != view_) {
        view_ = view;
        lightsHaveChanged();
        pictureIsStale_ = true;
    }
}

void Renderer::setResidual(ResidualUse use)
{
    if (use != residual_) {
        residual_ = use;
        ballsAreStale_ = ballsAreStale_ || plain_; // see ballsAreCodes
        lightsHaveChanged();
    }
}

bool Renderer::hasResidual() const
{
    return residual_ != ResidualUse::off && hasResidualFrom(surface_, view_);
}

// Of the display, rather than radiance to which something is done in each pixel.
bool Renderer::ballsAreCodes() const
{
    return plain_ && !hasResidual();
}

DirectFrame::Inputs Renderer::inputs(float gain)
{
    uploadLights();
    if (!hasResidual()) {
        return {tables_, groups_, plain_, nullptr};
    }
    ResidualWeights weights = residualFrame_.weights;
    if (residual_ == ResidualUse::alone) {
        weights.offset += glm::vec4(glm::vec3(kMiddleGrey / std::exp2(display_.exposureStops)), 0);
    }
    residualPass_.upload(weights, gain);
    return {tables_, groups_, plain_, &residualPass_};
}

void Renderer::setPath(RenderPath path)
{
    pictureIsStale_ = pictureIsStale_ || (path != path_ && show_ == Show::picture);
    path_ = path;
}

void Renderer::setDisplay(const Display& display)
{
    if (!(display == display_)) {
        pictureIsStale_ = pictureIsStale_ || dependsOnDisplay(show_);
        display_ = display;
        materialBallHasChanged();
    }
}

void Renderer::setShow(Show show)
{
    pictureIsStale_ = pictureIsStale_ || show != show_;
    show_ = show;
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
    if (show_ == Show::coverage) {
        return "coverage is looked up per pixel and light";
    }
    if (!isFromTheFront(view_)) {
        return "balls are for the view from the front";
    }
    if (surface_.materials.empty()) {
        return "there is no material";
    }
    if (viewpointOf(surface_, view_).w > 0) {
        return "the camera is near, and pixels of one normal see it from other sides";
    }
    if (anyIsNear(lights_)) {
        return "near lights differ between pixels of one normal";
    }
    if (!surface_.horizon.empty()) {
        return "cast shadows differ between pixels of one normal";
    }
    for (size_t i = 0; i < ballSizes().size(); ++i) {
        if (ballSizes()[i].radiance == 0) {
            return fmt::format("the highlight of '{}' is too sharp for a ball", surface_.materials[i].name);
        }
    }
    const VkDeviceSize bytes = BallCache::leastBytes(ballSizes(), !ballsAreCodes(), lights_.size());
    if (bytes > cacheBytes_) {
        return fmt::format("the balls of {} material(s) take {} MiB, {} may be cached", surface_.materials.size(),
                           bytes >> 20, cacheBytes_ >> 20);
    }
    return {};
}

RenderPath Renderer::pathTaken()
{
    if (path_ == RenderPath::direct || show_ == Show::coverage) {
        return RenderPath::direct;
    }
    const std::string reason = whyDirect();
    if (path_ == RenderPath::ball && !reason.empty()) {
        throw Error("", "there is no ball for this: " + reason, "path auto or direct", Error::kUsage);
    }
    return reason.empty() ? RenderPath::ball : RenderPath::direct;
}

const PixelTextures& Renderer::pixels()
{
    if (!pixels_) {
        pixels_ = uploadPixels(context_, surface_, plain_, Precision::compact);
    }
    return *pixels_;
}

Renderer::Target& Renderer::target()
{
    if (!picture_) {
        const VkExtent3D extent{static_cast<uint32_t>(surface_.normals.width),
                                static_cast<uint32_t>(surface_.normals.height), 1};
        picture_.emplace(
            Target{makeTarget(context_, extent, kCodeFormat),
                   Buffer(context_, VkDeviceSize{4} * extent.width * extent.height, VK_BUFFER_USAGE_TRANSFER_DST_BIT)});
    }
    return *picture_;
}

// Before near lights or a near camera; what was made of the surface without its places is dropped.
void Renderer::placePixels()
{
    if (surface_.places.empty() && needsPlaces(surface_, lights_, view_)) {
        surface_.places = pixelPlaces(surface_);
        dropPixels();
    }
}

void Renderer::uploadLights()
{
    if (lightsAreStale_) {
        placePixels();
        residualFrame_ = residualFrame(surface_.residual, lights_, hasResidual() ? residual_ : ResidualUse::off);
        groups_.upload(context_, residualFrame_.base, viewpointOf(surface_, view_));
        lightsAreStale_ = false;
    }
}

void Renderer::drawInto(const Texture& codes, const std::function<void(VkCommandBuffer)>& record)
{
    context_.run([&](VkCommandBuffer commands) {
        imageBarrier(commands, codes.image(), kDiscarded, kDrawnTo);
        record(commands);
        imageBarrier(commands, codes.image(), kDrawnTo, kCopiedFrom);
    });
}

void Renderer::drawDirectPicture()
{
    const DirectFrame::Look look{display_, show_ == Show::coverage};
    const PixelTextures& from = pixels();
    const DirectFrame::Inputs lit = inputs(1);
    const Texture& codes = target().texture;
    drawInto(codes, [&](VkCommandBuffer commands) { directFrame_.recordPicture(commands, from, lit, look, codes); });
}

void Renderer::drawFalseColours()
{
    const FalseColourConstants constants = falseColourConstants(lights_, view_, surface_.materials.size());
    const PixelTextures& from = pixels();
    const std::array inputs = {textureInput(kBindingNormals, nearest_, from.normals),
                               textureInput(kBindingAlbedo, nearest_, albedoOrAny(from))};
    const Pipeline& pipeline = falseColours_.with({!plain_, static_cast<int>(show_)});
    const Texture& codes = target().texture;
    drawInto(codes, [&](VkCommandBuffer commands) {
        beginRendering(commands, codes, Load::clear);
        draw(context_, commands, pipeline, inputs, bytesOf(constants));
        vkCmdEndRendering(commands);
    });
}

void Renderer::updateBalls()
{
    if (pathTaken() != RenderPath::ball) {
        return;
    }
    uploadLights();
    if (ballsAreStale_) {
        balls_.setMaterials(ballSizes(), !ballsAreCodes());
        ballsAreStale_ = false;
    }
    balls_.setLights(residualFrame_.base);
    balls_.setDisplay(display_);
    if (balls_.prepare()) {
        context_.run([&](VkCommandBuffer commands) { balls_.record(commands, tables_, groups_); });
    }
}

void Renderer::drawBallPicture()
{
    updateBalls();
    const PixelTextures& from = pixels();
    static_cast<void>(inputs(std::exp2(display_.exposureStops)));
    const BallFrame::Inputs lit{.balls = balls_,
                                .materials = static_cast<int>(tables_.size()),
                                .toneCurve = display_.toneCurve,
                                .residual = residualPass_,
                                .residualFours = hasResidual() ? from.residualFours : 0};
    const Texture& codes = target().texture;
    drawInto(codes, [&](VkCommandBuffer commands) { ballFrame_.record(commands, from, lit, codes); });
}

void Renderer::makeMaterialBall(size_t material, int size)
{
    Surface ball = transferredSurface(sphereNormalMap(size), {});
    if (!plain_) {
        for (uint8_t& label : ball.labels) {
            label = label == Surface::kNoMaterial ? label : static_cast<uint8_t>(material);
        }
    }
    const auto side = static_cast<uint32_t>(size);
    materialBall_.emplace(MaterialBall{material, size, uploadPixels(context_, ball, plain_, Precision::compact),
                                       BallFrame(context_), makeTarget(context_, {side, side, 1}, kCodeFormat)});
}

const Texture* Renderer::drawMaterialBall(size_t material, int size)
{
    if (pathTaken() != RenderPath::ball || (residual_ == ResidualUse::alone && hasResidual())) {
        return nullptr;
    }
    if (!materialBall_ || materialBall_->material != material || materialBall_->size != size) {
        makeMaterialBall(material, size);
    }
    if (!materialBall_->isStale) {
        return &materialBall_->texture;
    }
    updateBalls();
    const BallFrame::Inputs lit{.balls = balls_,
                                .materials = static_cast<int>(tables_.size()),
                                .toneCurve = display_.toneCurve,
                                .residual = residualPass_,
                                .residualFours = 0};
    materialBall_->isStale = false;
    drawInto(materialBall_->texture, [&](VkCommandBuffer commands) {
        materialBall_->frame.record(commands, materialBall_->pixels, lit, materialBall_->texture);
    });
    return &materialBall_->texture;
}

void Renderer::drawPicture()
{
    if (!pictureIsStale_) {
        return;
    }
    uploadLights();
    if (show_ != Show::picture && show_ != Show::coverage) {
        drawFalseColours();
    } else if (pathTaken() == RenderPath::ball) {
        drawBallPicture();
    } else {
        drawDirectPicture();
    }
    pictureIsStale_ = false;
    ++drawnPictures_;
}

Image Renderer::picture()
{
    drawPicture();
    context_.run([&](VkCommandBuffer commands) {
        const VkBufferImageCopy copy{.imageSubresource = {.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT, .layerCount = 1},
                                     .imageExtent = picture_->texture.extent()};
        vkCmdCopyImageToBuffer(commands, picture_->texture.image(), kCopiedFrom.layout, picture_->readback.get(), 1,
                               &copy);
        makeVisibleToHost(commands, picture_->readback);
    });
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
    if (!radiance_) {
        radiance_ = directFrame_.radiance(surface_, inputs(1));
    }
    return *radiance_;
}

float Renderer::automaticExposure()
{
    uploadLights();
    if (!exposurePixels_) {
        exposurePixels_ = sampledPixels(surface_, kExposurePixels);
    }
    return nacre::automaticExposure(exposureFrame_.radiance(*exposurePixels_, inputs(1)));
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
    VkDeviceSize bytes = balls_.bytes() + groups_.bytes() + ballFrame_.bytes() + directFrame_.bytes() +
                         exposureFrame_.bytes() + residualPass_.bytes();
    for (const TableTexture& table : tables_) {
        bytes += table.texture.bytes();
    }
    bytes += pixels_ ? pixels_->bytes() : 0;
    bytes += picture_ ? picture_->texture.bytes() + picture_->readback.bytes() : 0;
    return bytes;
}

} // namespace nacre
