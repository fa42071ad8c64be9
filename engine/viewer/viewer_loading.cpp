#include <fmt/format.h>

#include "engine/scene/error.h"
#include "engine/viewer/picture_texture.h"
#include "engine/viewer/thumbnails.h"
#include "engine/viewer/viewer_window.h"

namespace nacre {

namespace {

constexpr int kBallSize = 200; // units of layout
constexpr int kFramesToSettle = 3;

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
    session_.hasPhotographs = photographsAreRead_ && state.onto.empty() && !state.surface.empty();
    framesLeft_ = kFramesToSettle;
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
    const std::string name = fmt::format(
        "reading {}", requested_.material.empty() ? requested_.surface.filename().string()
                                                  : std::filesystem::path(requested_.material).filename().string());
    sceneLoader_.start(name, [this, state = requested_, choices = choices_, before = loaded_,
                              scene = pictures_.scene()](Loader::Progress&) {
        auto loaded = std::make_shared<LoadedScene>(loadScene(source_, state, choices, before, scene));
        return [this, state, loaded] { takeScene(state, *loaded); };
    });
}

// What is shown stays, and so does what the state says of it.
void ViewerWindow::cancelLoading()
{
    if (sceneLoader_.isBusy()) {
        copyLoadedPart(session_.state, loaded_);
        requested_ = session_.state;
        sceneLoader_.cancel();
    } else {
        photographLoader_.cancel();
    }
}

void ViewerWindow::finishLoading()
{
    try {
        if (sceneLoader_.finish() || photographLoader_.finish()) {
            framesLeft_ = kFramesToSettle;
        }
    } catch (const Error& e) {
        message_ = e.what();
        copyLoadedPart(session_.state, loaded_);
        requested_ = session_.state;
        framesLeft_ = kFramesToSettle;
    }
    try {
        if (thumbnailLoader_.finish()) {
            framesLeft_ = kFramesToSettle;
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
            photographs_.reset(); // they are another surface's
            photographsAreRead_ = false;
            takeScene(state, *loaded);
            session_ = {.state = state};
            requested_ = state;
            applyState();
            session_.opened = session_.state;
        };
    });
}

} // namespace nacre
