#include "engine/gpu/renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scene/scene_residual.h"
#include "engine/surface/object_places.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace {

constexpr float kMiddleGrey = 0.2140f; // linear, of code 0.5: what a layer by itself is drawn about

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
      cacheBytes_(cacheBytes), own_(context, direct_), device_(context, direct_), exposureFrame_(context, direct_),
      falseColours_(context), nearer_(context, direct_), zoomFrame_(context)
{
}

void Renderer::pictureHasChanged()
{
    own_.isStale = nearer_.isStale = device_.isStale = true;
}

// What was made of the surface's pixels.
void Renderer::dropPixels()
{
    dropDevicePixels();
    own_.dropPixels();
    nearer_.dropPixels();
    magnified_.reset();
    zoomIsStale_ = true;
    exposurePixels_.reset();
    exposureFrame_.reset();
}

void Renderer::dropDevicePixels()
{
    device_.dropPixels();
    hasDevicePixels_ = false;
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
    own_.dropPicture();
    ballSizes_ = std::move(sizes);
    lightsAreStale_ = true;
    radiance_.reset();
    materialBall_.reset();
    balls_.drop();
}

void Renderer::setPixels(const Surface& pixels)
{
    const bool isOtherSize =
        pixels.normals.width != surface_.normals.width || pixels.normals.height != surface_.normals.height;
    const bool hadLayer = !surface_.residual.empty();
    surface_.normals = pixels.normals;
    surface_.albedo = pixels.albedo;
    surface_.residual = pixels.residual;
    surface_.labels = pixels.labels;
    surface_.height = pixels.height;
    surface_.horizon = pixels.horizon;
    surface_.places = pixels.places;
    surface_.camera = pixels.camera;
    dropPixels();
    radiance_.reset();
    if (hadLayer == surface_.residual.empty()) { // see ballsAreCodes
        balls_.drop();
        lightsHaveChanged();
    }
    if (isOtherSize) {
        own_.dropPicture();
    }
}

void Renderer::setDevicePixels(std::shared_ptr<const PixelTextures> pixels)
{
    device_.usePixels(std::move(pixels));
    hasDevicePixels_ = true;
}

bool Renderer::drawsFromDevice(std::span<const Light> lights) const
{
    return plain_ && surface_.residual.empty() && !surface_.camera && !anyIsNear(lights);
}

void Renderer::setZoom(const std::optional<Zoom>& zoom)
{
    if (zoom == zoom_) {
        return;
    }
    if (zoom) {
        requirePictureSize(context_, zoom->size.x, zoom->size.y);
    }
    if (!zoom || !zoom_ || zoom->size != zoom_->size) {
        nearer_.dropPicture();
    }
    dropDevicePixels();
    nearer_.dropPixels();
    magnified_.reset();
    radiance_.reset();
    zoom_ = zoom;
    zoomIsStale_ = true;
}

void Renderer::materialBallHasChanged()
{
    if (materialBall_) {
        materialBall_->canvas.isStale = true;
    }
}

void Renderer::lightsHaveChanged()
{
    materialBallHasChanged();
    lightsAreStale_ = true;
    radiance_.reset();
    if (dependsOnLights(show_)) {
        pictureHasChanged();
    }
}

void Renderer::setLights(std::span<const Light> lights)
{
    if (!std::equal(lights.begin(), lights.end(), lights_.begin(), lights_.end())) {
        lights_.assign(lights.begin(), lights.end());
        lightsHaveChanged();
    }
}

void Renderer::setLightsMove(bool move)
{
    if (move != lightsMove_) {
        lightsMove_ = move;
        movingLights_.forget();
        lightsHaveChanged();
    }
}

void Renderer::setView(const glm::vec3& view)
{
    if (view != view_) {
        view_ = view;
        lightsHaveChanged();
        pictureHasChanged();
    }
}

void Renderer::setResidual(ResidualUse use)
{
    if (use != residual_) {
        residual_ = use;
        if (plain_) { // see ballsAreCodes
            balls_.drop();
        }
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
        return {tables_, groups_, order_.still, order_.moved, plain_, nullptr};
    }
    ResidualWeights weights = residualFrame_.weights;
    if (residual_ == ResidualUse::alone) {
        weights.offset += glm::vec4(glm::vec3(kMiddleGrey / std::exp2(display_.exposureStops)), 0);
    }
    residualPass_.upload(weights, gain);
    return {tables_, groups_, order_.still, order_.moved, plain_, &residualPass_};
}

void Renderer::setPath(RenderPath path)
{
    if (path != path_ && show_ == Show::picture) {
        pictureHasChanged();
    }
    path_ = path;
}

void Renderer::setDisplay(const Display& display)
{
    if (!(display == display_)) {
        if (dependsOnDisplay(show_)) {
            pictureHasChanged();
        }
        display_ = display;
        materialBallHasChanged();
    }
}

void Renderer::setShow(Show show)
{
    if (show != show_) {
        pictureHasChanged();
    }
    show_ = show;
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
        order_ = lightsMove_ ? movingLights_.follow(residualFrame_.base)
                             : MovingLights::Order{residualFrame_.base, {}, {0, residualFrame_.base.size()}};
        groups_.upload(context_, order_.lights, viewpointOf(surface_, view_));
        lightsAreStale_ = false;
    }
}

void Renderer::drawDirectly(const Shaded& shaded)
{
    const DirectFrame::Look look{display_, show_ == Show::coverage};
    const PixelTextures& from = shaded.canvas.pixels(shaded.pixels, plain_);
    const DirectFrame::Inputs lit = inputs(1);
    shaded.canvas.draw(Canvas::Draws::whatIsShown, [&](VkCommandBuffer commands, const Texture& codes) {
        shaded.canvas.directFrame.recordPicture(commands, from, lit, look, codes);
    });
}

void Renderer::drawFalseColours(const Shaded& shaded)
{
    const FalseColourConstants constants = falseColourConstants(lights_, view_, surface_.materials.size());
    const PixelTextures& from = shaded.canvas.pixels(shaded.pixels, plain_);
    shaded.canvas.draw(Canvas::Draws::everything, [&](VkCommandBuffer commands, const Texture& codes) {
        falseColours_.record(commands, from, show_, constants, codes);
    });
}

void Renderer::updateBalls()
{
    if (pathTaken() == RenderPath::ball) {
        updatedBalls();
    }
}

const BallCache& Renderer::updatedBalls()
{
    uploadLights();
    return balls_.updated(lightsMove_, {drawnBallSizes(), !ballsAreCodes(), order_, display_, tables_, groups_});
}

void Renderer::drawFromBalls(const Shaded& shaded, bool withResidual)
{
    const BallCache& balls = updatedBalls();
    const PixelTextures& from = shaded.canvas.pixels(shaded.pixels, plain_);
    static_cast<void>(inputs(std::exp2(display_.exposureStops)));
    const BallFrame::Inputs lit{.balls = balls,
                                .materials = static_cast<int>(tables_.size()),
                                .toneCurve = display_.toneCurve,
                                .residual = residualPass_,
                                .residualFours = withResidual ? from.residualFours : 0};
    shaded.canvas.draw(Canvas::Draws::whatIsShown, [&](VkCommandBuffer commands, const Texture& codes) {
        shaded.canvas.ballFrame.record(commands, from, lit, codes);
    });
}

void Renderer::makeMaterialBall(size_t material, int size)
{
    Surface ball = transferredSurface(sphereNormalMap(size), {});
    if (!plain_) {
        for (uint8_t& label : ball.labels) {
            label = label == Surface::kNoMaterial ? label : static_cast<uint8_t>(material);
        }
    }
    materialBall_.emplace(MaterialBall{material, size, std::move(ball), Canvas(context_, direct_)});
}

const Texture* Renderer::drawMaterialBall(size_t material, int size)
{
    if (pathTaken() != RenderPath::ball || (residual_ == ResidualUse::alone && hasResidual())) {
        return nullptr;
    }
    if (!materialBall_ || materialBall_->material != material || materialBall_->size != size) {
        makeMaterialBall(material, size);
    }
    if (materialBall_->canvas.isStale) {
        drawFromBalls({materialBall_->canvas, materialBall_->pixels}, false);
    }
    return &materialBall_->canvas.codes();
}

Renderer::Shaded Renderer::shaded()
{
    return hasDevicePixels_ ? Shaded{device_, surface_} : shadedSurface();
}

Renderer::Shaded Renderer::shadedSurface()
{
    if (!zoom_ || !zoom_->magnifies()) {
        return {own_, surface_};
    }
    if (!magnified_) {
        magnified_ = magnified(surface_, *zoom_);
    }
    return {nearer_, magnified_->pixels};
}

void Renderer::shade(const Shaded& shaded)
{
    if (show_ != Show::picture && show_ != Show::coverage) {
        drawFalseColours(shaded);
    } else if (pathTaken() == RenderPath::ball) {
        drawFromBalls(shaded, hasResidual());
    } else {
        drawDirectly(shaded);
    }
}

void Renderer::drawZoomed(const Canvas& shaded)
{
    if (zoomIsStale_) {
        zoomFrame_.set(*zoom_, magnified_ ? std::span<const uint8_t>(magnified_->cover) : std::span<const uint8_t>());
        zoomIsStale_ = false;
    }
    zoomFrame_.draw(shaded.codes(), shaded.drawn());
}

void Renderer::drawPicture()
{
    uploadLights();
    const Shaded shaded = this->shaded();
    const bool isStale = shaded.canvas.isStale;
    const bool isZoomed = zoom_ && !hasDevicePixels_;
    if (!isStale && !(isZoomed && zoomIsStale_)) {
        return;
    }
    if (isStale) {
        shade(shaded);
    }
    if (isZoomed) {
        drawZoomed(shaded.canvas);
    }
    ++drawnPictures_;
}

Image Renderer::picture()
{
    drawPicture();
    return readCodes(context_, drawnPicture());
}

Frame Renderer::radiance()
{
    if (!radiance_) {
        const DirectFrame::Inputs lit = inputs(1);
        const Shaded shaded = shadedSurface();
        radiance_ = shaded.canvas.directFrame.radiance(shaded.pixels, lit);
        if (zoom_) {
            radiance_ = zoom_->magnifies() ? coveredRadiance(*radiance_, magnified_->cover)
                                           : reducedRadiance(*radiance_, *zoom_);
        }
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
    VkDeviceSize bytes = balls_.bytes() + groups_.bytes() + own_.bytes() + device_.bytes() + nearer_.bytes() +
                         zoomFrame_.bytes() + exposureFrame_.bytes() + residualPass_.bytes();
    for (const TableTexture& table : tables_) {
        bytes += table.texture.bytes();
    }
    return bytes;
}

} // namespace nacre
