#include "engine/viewer/viewer_window.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>
#include <imgui.h>

#include "engine/files/error.h"
#include "engine/scene/scene_residual.h"
#include "engine/viewer/comparison.h"
#include "engine/viewer/picture_texture.h"
#include "engine/viewer/screenshot.h"

namespace nacre {

namespace {

constexpr double kMostFramesPerSecond = 60; // FIFO does not hold every driver back
constexpr float kPanelWidth = 300;          // units of layout
constexpr float kInspectorWidth = 250;
constexpr float kStatusHeight = 26;
constexpr double kProgressSeconds = 0.1; // between looks at what is loading
constexpr glm::vec3 kBackground{0.11f, 0.11f, 0.12f};
constexpr int kFramesToSettle = 3;
constexpr size_t kFewLights = 16; // of which the light ball's few pixels are drawn sooner than another ball is made

double secondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

ViewerWindow::ViewerWindow(const Context& context, ViewState state, Choices choices, const SceneSource& source,
                           const ViewerOptions& options)
    : context_(context), source_(source), options_(options), window_("nacre", options.width, options.height),
      swapchain_(context, window_), ui_(context, window_, swapchain_), pictures_(context), ball_(context),
      choices_(std::move(choices)), photographs_(source.photographs)
{
    view_ = source_.view(sceneFileOf(state));
    takeScene(state, loadScene(source_, state, choices_, {}, {}));
    requireResidual(pictures_.scene().main->surface, view_, state.residual);
    session_.state = loaded_ = requested_ = state;
    applyState();
    session_.opened = session_.state;
    if (photographs_) {
        loadPhotographs();
    }
}

void ViewerWindow::run()
{
    while (!session_.wantsToQuit && !window_.shouldClose()) {
        keepPace();
        takeEvents(window_.waitForEvents(waitingTime()));
        finishLoading();
        followState();
        if (session_.wantsScreenshot) {
            takeScreenshot();
        }
        const glm::ivec2 size = window_.framebufferSize();
        if (!swapchain_.isEmpty() && size.x > 0 && size.y > 0 && framesLeft_ > 0) {
            drawFrame();
        }
    }
    fmt::print("showed       {} pictures\n", shownFrames_);
}

// 0 while something moves; negative where nothing does until something happens.
double ViewerWindow::waitingTime() const
{
    if (swapchain_.isEmpty()) {
        return -1;
    }
    if (framesLeft_ > 0) {
        return 0;
    }
    return sceneLoader_.isBusy() || photographLoader_.isBusy() ? kProgressSeconds : -1;
}

void ViewerWindow::keepPace()
{
    const double left = 1 / kMostFramesPerSecond - secondsSince(lastFrame_);
    if (framesLeft_ > 0 && left > 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(left));
    }
}

float ViewerWindow::panelWidth() const
{
    const auto width = static_cast<float>(swapchain_.extent().width);
    return std::min(kPanelWidth * ui_.scale(), 0.4f * width);
}

float ViewerWindow::inspectorWidth() const
{
    const auto width = static_cast<float>(swapchain_.extent().width);
    return std::min(kInspectorWidth * ui_.scale(), 0.3f * width);
}

// What the panels and the status line leave of the window.
Area ViewerWindow::pictureArea() const
{
    const glm::vec2 size(swapchain_.extent().width, swapchain_.extent().height);
    const glm::vec2 taken(panelWidth() + inspectorWidth(), kStatusHeight * ui_.scale());
    return {{inspectorWidth(), 0}, glm::max(size - taken, glm::vec2(1))};
}

Framing ViewerWindow::framing() const
{
    return resolved(session_.state.framing, pictures_.size(), pictureArea());
}

void ViewerWindow::applyState()
{
    settleShow(session_);
    pictures_.apply(session_.state, view_, choices_.captured);
    const bool isFew = pictures_.lights().size() <= kFewLights;
    ball_.setPath(isFew ? RenderPath::direct : RenderPath::automatic);
    ball_.setLights(pictures_.lights());
    ball_.setDisplay(pictures_.display());
}

void ViewerWindow::drawPictures()
{
    applyState();
    pictures_.draw();
    if (pictures_.scene().main->surface.materials.empty()) {
        return;
    }
    ball_.drawPicture();
    drawComparison();
}

void ViewerWindow::drawComparison()
{
    if (session_.comparison == Comparison::none || !session_.photograph || !photographsAreRead_) {
        comparison_.reset();
        compared_.reset();
        comparisonFigures_.clear();
        return;
    }
    const std::pair now(*session_.photograph, pictures_.renderer().drawnPictures());
    if (compared_ == now && comparedBy_ == session_.comparison) {
        return;
    }
    const Surface& surface = pictures_.scene().main->surface;
    const Image photograph =
        fittedPicture(photographs_->picture(*session_.photograph), surface.normals.width, surface.normals.height);
    compared_ = now;
    comparedBy_ = session_.comparison;
    comparison_ = uploadPicture(context_, comparisonPicture(session_.comparison, photograph,
                                                            pictures_.renderer().picture(), pictures_.display()));
    comparisonFigures_ = describeComparison(photograph, pictures_.radiance(), surface, photographs_->peak());
}

void ViewerWindow::drawFrame()
{
    lastFrame_ = Clock::now();
    --framesLeft_;
    drawPictures();
    placed_.clear();
    placePicture();
    ui_.begin();
    showPanels();
    ui_.end();
    const bool wasShown = swapchain_.show([&](VkCommandBuffer commands, size_t image) {
        recordPictures(commands, swapchain_.image(image), placed_, kBackground);
        ui_.record(commands, swapchain_, image);
    });
    if (!wasShown) {
        swapchain_.rebuild();
        framesLeft_ = kFramesToSettle;
    }
    ++shownFrames_;
    showTitle(secondsSince(lastFrame_));
    if (session_.playing) {
        play(session_, static_cast<float>(std::max(frameSeconds_, 1 / kMostFramesPerSecond)));
        framesLeft_ = std::max(framesLeft_, 1);
    }
}

void ViewerWindow::showTitle(double seconds)
{
    frameSeconds_ = frameSeconds_ > 0 ? 0.8 * frameSeconds_ + 0.2 * seconds : seconds;
    const std::string name = choices_.surface.empty() ? session_.state.material : choices_.surface.stem().string();
    window_.setTitle(
        fmt::format("{} - nacre - {} - {:.1f} ms a frame", name, context_.info().name, 1000 * frameSeconds_));
}

void runViewer(const Context& context, ViewState state, Choices choices, const SceneSource& source,
               const ViewerOptions& options)
{
    resolveCaptured(state, choices.captured);
    requireShown(state, source);
    ViewerWindow(context, std::move(state), std::move(choices), source, options).run();
}

void viewHeadless(const Context& context, ViewState state, const Choices& choices, const SceneSource& source,
                  const std::filesystem::path& output)
{
    resolveCaptured(state, choices.captured);
    requireShown(state, source);
    ViewPictures pictures(context);
    if (state.show == Show::verdicts) {
        source.photographs->load([](float) {}, false);
        pictures.setPhotographs(&*source.photographs);
    }
    pictures.setScene(loadScene(source, state, choices, {}, {}));
    const glm::vec3 view = source.view(sceneFileOf(state));
    requireResidual(pictures.scene().main->surface, view, state.residual);
    pictures.apply(state, view, choices.captured);
    saveScreenshot(output, pictures.picture(), state);
    if (!pictures.verdicts().empty()) {
        fmt::print("verdicts     {}\n", describeVerdicts(pictures.verdicts()));
    }
}

} // namespace nacre
