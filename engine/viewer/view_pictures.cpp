#include "engine/viewer/view_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/loading/scene_loading.h"
#include "engine/scene/coverage.h"
#include "engine/scene/scene_residual.h"
#include "engine/surface/normal_map.h"
#include "engine/viewer/placed_picture.h"

namespace nacre {
namespace {

constexpr float kDifferenceGain = 2;           // of codes, around middle grey
constexpr size_t kMostCertaintyPairs = 20'000; // of pixel and light: milliseconds

// The picture fitted into another size as surfaces are (fittedPixels), 0 outside.
Image fittedPicture(const Image& picture, int width, int height)
{
    const std::vector<int64_t> from = fittedPixels(picture.width, picture.height, width, height);
    Image fitted(width, height, 3);
    for (size_t i = 0; i < from.size(); ++i) {
        for (size_t c = 0; from[i] >= 0 && c < 3; ++c) {
            fitted.values[3 * i + c] = picture.values[3 * static_cast<size_t>(from[i]) + c];
        }
    }
    return fitted;
}

// What stands in place of the render: the photograph exposed as the render is, or the difference of both's codes,
// brighter than middle grey where the photograph is.
Image comparisonPicture(Comparison comparison, const Image& photograph, const Image& render, const Display& display)
{
    Image picture = displayedImage(photograph, display);
    if (comparison == Comparison::difference) {
        for (size_t i = 0; i < picture.values.size(); ++i) {
            const float difference = 0.5f + kDifferenceGain * (picture.values[i] - render.values[i]);
            picture.values[i] = std::round(255 * std::clamp(difference, 0.0f, 1.0f)) / 255;
        }
    }
    return picture;
}

// PSNR of radiance over the pixels that have a material, and the mean of photograph over render there.
std::string describeComparison(const Image& photograph, const Frame& render, const Surface& surface, double peak)
{
    std::vector<uint8_t> mask(surface.labels.size());
    double photographed = 0, rendered = 0;
    for (size_t i = 0; i < mask.size(); ++i) {
        mask[i] = surface.labels[i] < surface.materials.size() && surface.normals.confidence[i] > 0;
        for (size_t c = 0; mask[i] && c < 3; ++c) {
            photographed += photograph.values[3 * i + c];
            rendered += render.values[3 * i + c];
        }
    }
    const double ratio = rendered > 0 ? photographed / rendered : 0;
    return fmt::format("PSNR {:.1f} dB of radiance over the object; photograph / render in the mean {:.3f}",
                       radiancePsnr(photograph, render, mask, peak), ratio);
}

MeshRaster& rasterOf(const Context& context, DrawnSurface& drawn, const ViewState& state)
{
    if (!drawn.raster) {
        drawn.raster = meshRasterFor(context, drawn.mesh, state);
    }
    return *drawn.raster;
}

} // namespace

void ViewPictures::setScene(const LoadedScene& scene, const ViewState& state)
{
    isTurning_ = false;
    turnTo(state);
    for (DrawnSurface* drawn : {scene.main.get(), scene.other.get()}) {
        const bool isDrawn = drawn == scene_.main.get() || drawn == scene_.other.get();
        if (drawn && drawn->mesh && !isDrawn) {
            drawMesh(rasterOf(context_, *drawn, state), state, drawn->surface);
        }
    }
    if (scene.main != scene_.main) {
        main_.setSurface(scene.main->surface, scene.main->ballSizes);
    }
    if (!scene.other) {
        other_.reset();
    } else if (scene.other != scene_.other || !other_) {
        other_ = std::make_unique<Renderer>(context_);
        other_->setSurface(scene.other->surface, scene.other->ballSizes);
    }
    scene_ = scene;
    verdicts_.reset();
}

void ViewPictures::turnTo(const ViewState& state)
{
    const bool onDevice = isTurning_ && main_.drawsFromDevice(lights_);
    const Pose pose{state.turn, isTurning_, onDevice, onDevice ? zoom_ : std::nullopt};
    if (pose == pose_ || pose_ == Pose{state.turn}) {
        return;
    }
    pose_ = pose;
    const std::pair<DrawnSurface*, Renderer*> drawn[] = {{scene_.main.get(), &main_},
                                                         {scene_.other.get(), other_.get()}};
    for (const auto& [surface, renderer] : drawn) {
        if (surface && surface->mesh) {
            drawTurned(*surface, *renderer, state);
        }
    }
}

void ViewPictures::drawTurned(DrawnSurface& drawn, Renderer& renderer, const ViewState& state) const
{
    MeshRaster& raster = rasterOf(context_, drawn, state);
    if (pose_.onDevice) {
        renderer.setZoom(pose_.zoom);
        renderer.setDevicePixels(drawMeshPixels(raster, state, pose_.zoom));
    } else {
        drawMesh(raster, state, drawn.surface, pose_.isCoarse);
        renderer.setPixels(drawn.surface);
    }
}

void ViewPictures::applyTo(Renderer& renderer, const ViewState& state, const glm::vec3& view) const
{
    renderer.setView(view);
    renderer.setLightsMove(lightsMove_);
    renderer.setLights(lights_);
    renderer.setDisplay(display_);
    renderer.setShow(state.show == Show::verdicts ? Show::picture : state.show);
    renderer.setResidual(state.residual);
}

void ViewPictures::applyVerdicts(const ViewState& state)
{
    const bool isAsked = state.show == Show::verdicts && photographs_ != nullptr;
    const std::optional<size_t> light = isAsked ? shownPhotograph(state) : std::nullopt;
    if (!light) {
        verdicts_.reset();
    } else if (!verdicts_ || verdicts_->light != *light) {
        std::vector<uint8_t> ofPixels = photographs_->verdicts(*light);
        Image picture = verdictPicture(ofPixels, photographs_->size(), size().x, size().y);
        Texture texture = uploadPicture(context_, picture);
        verdicts_ = Verdicts{*light, std::move(ofPixels), std::move(picture), std::move(texture)};
    }
}

void ViewPictures::apply(ViewState& state, const glm::vec3& view, std::span<const CapturedLight> captured)
{
    lights_ = lightsOfScene(state, scene_.environment.get(), captured);
    turnTo(state);
    view_ = view;
    wipeAt_ = state.wipe.at;
    if (!state.exposure) {
        main_.setView(view);
        main_.setLights(lights_);
        main_.setResidual(residualOfExposure(state.residual));
        state.exposure = main_.automaticExposure();
    }
    display_ = {.exposureStops = *state.exposure, .toneCurve = state.toneCurve};
    applyTo(main_, state, view);
    if (other_) {
        applyTo(*other_, state, view);
    }
    applyVerdicts(state);
}

void ViewPictures::zoomTo(const std::optional<Zoom>& zoom)
{
    main_.setZoom(zoom);
    if (other_) {
        other_->setZoom(zoom);
    }
}

bool ViewPictures::draw()
{
    const auto drawn = [&] { return main_.drawnPictures() + (other_ ? other_->drawnPictures() : 0); };
    const size_t before = drawn();
    if (verdicts_) {
        return false;
    }
    zoomTo(zoom_);
    main_.drawPicture();
    if (other_) {
        other_->drawPicture();
    }
    return drawn() != before;
}

glm::ivec2 ViewPictures::size() const
{
    const NormalMap& normals = scene_.main->surface.normals;
    return {normals.width, normals.height};
}

int ViewPictures::wipeColumn() const
{
    const int width = size().x;
    return hasWipe() ? static_cast<int>(std::lround(std::clamp(wipeAt_, 0.0f, 1.0f) * static_cast<float>(width)))
                     : width;
}

Image ViewPictures::picture()
{
    if (verdicts_) {
        return verdicts_->picture;
    }
    zoomTo({});
    Image picture = main_.picture();
    if (hasWipe()) {
        const Image other = other_->picture();
        for (int y = 0; y < picture.height; ++y) {
            for (int x = wipeColumn(); x < picture.width; ++x) {
                picture.setRgb(x, y, other.rgb(x, y));
            }
        }
    }
    return picture;
}

double ViewPictures::uncertainShare()
{
    if (!uncertain_ || uncertain_->first != main_.drawnPictures()) {
        uncertain_ = {main_.drawnPictures(),
                      nacre::uncertainShare(scene_.main->surface, lights_, view_, kMostCertaintyPairs)};
    }
    return uncertain_->second;
}

void PhotographComparison::update(const Session& session, const Photographs* photographs, ViewPictures& pictures)
{
    if (session.comparison == Comparison::none || !session.photograph || !photographs) {
        picture_.reset();
        compared_.reset();
        figures_.clear();
        return;
    }
    const std::pair now(*session.photograph, pictures.renderer().drawnPictures());
    if (compared_ == now && by_ == session.comparison) {
        return;
    }
    const Surface& surface = pictures.scene().main->surface;
    const Image photograph =
        fittedPicture(photographs->picture(*session.photograph), surface.normals.width, surface.normals.height);
    compared_ = now;
    by_ = session.comparison;
    picture_ = uploadPicture(
        context_, comparisonPicture(session.comparison, photograph, pictures.renderer().picture(), pictures.display()));
    figures_ = describeComparison(photograph, pictures.radiance(), surface, photographs->peak());
}

} // namespace nacre
