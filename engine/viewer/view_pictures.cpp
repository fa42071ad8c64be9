#include "engine/viewer/view_pictures.h"

#include <algorithm>
#include <cmath>

#include "engine/loading/scene_loading.h"
#include "engine/scene/scene_residual.h"
#include "engine/viewer/picture_texture.h"

namespace nacre {

void ViewPictures::setScene(const LoadedScene& scene)
{
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

void ViewPictures::applyTo(Renderer& renderer, const ViewState& state, const glm::vec3& view) const
{
    renderer.setView(view);
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

bool ViewPictures::draw()
{
    const auto drawn = [&] { return main_.drawnPictures() + (other_ ? other_->drawnPictures() : 0); };
    const size_t before = drawn();
    if (verdicts_) {
        return false;
    }
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

} // namespace nacre
