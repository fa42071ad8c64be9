#include <fmt/format.h>

#include "engine/files/error.h"
#include "engine/scene/scene_residual.h"
#include "engine/viewer/picture_texture.h"
#include "engine/viewer/thumbnails.h"
#include "engine/viewer/viewer_window.h"

namespace nacre {

namespace {

constexpr int kBallSize = 200; // units of layout
constexpr int kLoadingFramesToSettle = 3;

// Whether what is loaded for one state serves the other.
bool sharesScene(const ViewState& a, const ViewState& b)
{
    return loadedPart(a) == loadedPart(b) && a.wipe.material == b.wipe.material && a.environment == b.environment;
}

// What a state asks to be loaded, from another one.
void copyLoadedPart(ViewState& to, const ViewState& from)
{
    to.surface = from.surface;
    to.material = from.material;
    to.onto = from.onto;
    to.normalY = from.normalY;
    to.size = from.size;
    to.shadows = from.shadows;
    to.wipe = from.wipe;
    to.environment = from.environment;
}

// By what differs from what is loaded.
std::string nameOfLoading(const ViewState& wanted, const ViewState& loaded)
{
    std::filesystem::path named = wanted.material.empty() ? wanted.surface : std::filesystem::path(wanted.material);
    if (wanted.environment != loaded.environment) {
        named = wanted.environment;
    } else if (!wanted.onto.empty() && wanted.onto != loaded.onto) {
        named = wanted.onto;
    } else if (wanted.wipe.material != loaded.wipe.material) {
        named = wanted.wipe.material;
    }
    return fmt::format("reading {}", named.filename().string());
}

} // namespace

void ViewerWindow::takeScene(const ViewState& state, const LoadedScene& scene)
{
    const bool isOtherMaterial = scene.main != pictures_.scene().main;
    pictures_.setScene(scene);
    if (isOtherMaterial && !scene.main->surface.materials.empty()) {
        const auto size = static_cast<int>(kBallSize * ui_.scale());
        ball_.setSurface(ballSurface(scene.main->surface, size));
        pixel_.reset();
    }
    loaded_ = state;
    drop_.reset();
    session_.hasPhotographs = photographsAreRead_ && state.onto.empty() && !state.surface.empty();
    session_.hasResidual = hasResidualFrom(scene.main->surface, view_);
    framesLeft_ = kLoadingFramesToSettle;
}

// Starts reading where the state has come to ask for something else than what is shown.
void ViewerWindow::followState()
{
    if (sharesScene(session_.state, requested_)) {
        return;
    }
    requested_ = session_.state;
    if (sharesScene(requested_, loaded_)) {
        sceneLoader_.cancel();
        return;
    }
    sceneLoader_.start(
        nameOfLoading(requested_, loaded_),
        [this, state = requested_, choices = choices_, before = loaded_, scene = pictures_.scene()](Loader::Progress&) {
            auto loaded = std::make_shared<LoadedScene>(loadScene(source_, state, choices, before, scene));
            return [this, state, loaded] { takeScene(state, *loaded); };
        });
}

// What is shown stays, and so does what the state says of it; what was dropped for it leaves the lists again.
void ViewerWindow::keepLoaded()
{
    ViewState& state = session_.state;
    if (drop_ && state == drop_->after) {
        state = drop_->before;
    } else if (drop_) { // what else was done meanwhile remains
        state.materials = drop_->before.materials;
        state.targets = drop_->before.targets;
        state.environments = drop_->before.environments;
    }
    if (drop_) {
        choices_ = drop_->choices;
        drop_.reset();
    }
    copyLoadedPart(state, loaded_);
    if (state.lights.empty() && state.environment.empty()) { // something has to light the scene
        addLight(session_);
    }
    requested_ = session_.state;
    framesLeft_ = kLoadingFramesToSettle;
}

void ViewerWindow::cancelLoading()
{
    Loader& loader = sceneLoader_.isBusy() ? sceneLoader_ : photographLoader_;
    session_.message = fmt::format("cancelled {}", loader.name());
    loader.cancel();
    if (&loader == &sceneLoader_) {
        keepLoaded();
    }
}

void ViewerWindow::finishLoading()
{
    try {
        if (sceneLoader_.finish() || photographLoader_.finish()) {
            framesLeft_ = kLoadingFramesToSettle;
        }
    } catch (const Error& e) {
        session_.message = e.what();
        keepLoaded();
    }
    try {
        if (thumbnailLoader_.finish()) {
            framesLeft_ = kLoadingFramesToSettle;
        }
    } catch (const Error&) {
        // The list does without this picture; choosing the material says what is wrong with it.
    }
    loadNextThumbnail();
}

void ViewerWindow::loadNextThumbnail()
{
    for (const MaterialChoice& choice : choices_.materials) {
        const std::string specification = choice.specification;
        if (thumbnailLoader_.isBusy() || !triedThumbnails_.emplace(specification, true).second) {
            continue;
        }
        const std::string named = specification.empty() ? choices_.surface.string() : specification;
        thumbnailLoader_.start("", [this, specification, named](Loader::Progress&) {
            auto material = std::make_shared<Material>(source_.material(named));
            return [this, specification, material] {
                const auto size = static_cast<int>(kThumbnailSize * ui_.scale());
                thumbnails_.insert_or_assign(specification,
                                             uploadPicture(context_, materialThumbnail(context_, *material, size)));
            };
        });
    }
}

void ViewerWindow::loadPhotographs()
{
    photographLoader_.start("reading photographs", [this, photographs = *photographs_](Loader::Progress& progress) {
        photographs.load([&](float share) { progress.share = share; }, progress.isCancelled);
        return [this] {
            photographsAreRead_ = true;
            pictures_.setPhotographs(&*photographs_);
            session_.hasPhotographs = loaded_.onto.empty() && !loaded_.surface.empty();
        };
    });
}

void ViewerWindow::openSurface(const std::filesystem::path& folder)
{
    sceneLoader_.start(fmt::format("reading {}", folder.filename().string()), [this, folder](Loader::Progress&) {
        auto choices = std::make_shared<Choices>(source_.choices(folder));
        ViewState state;
        state.surface = folder;
        resolveCaptured(state, choices->captured);
        auto loaded = std::make_shared<LoadedScene>(loadScene(source_, state, *choices, {}, {}));
        return [this, state, choices, loaded] {
            choices_ = *choices;
            thumbnails_.clear();
            triedThumbnails_.clear();
            photographLoader_.cancel();
            pictures_.setPhotographs(nullptr);
            photographs_.reset(); // they are another surface's
            photographsAreRead_ = false;
            takeScene(state, *loaded);
            session_ = {
                .state = state, .hasResidual = session_.hasResidual, .wantsScreenshot = session_.wantsScreenshot};
            requested_ = state;
            applyState();
            session_.opened = session_.state;
        };
    });
}

} // namespace nacre
