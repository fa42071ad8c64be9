#include "engine/viewer/viewer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <imgui.h>

#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/gpu/renderer.h"
#include "engine/gpu/texture.h"
#include "engine/scene/coverage.h"
#include "engine/scene/scene_residual.h"
#include "engine/view_state/opening_hint.h"
#include "engine/view_state/recent_files.h"
#include "engine/viewer/background_loads.h"
#include "engine/viewer/frame_pace.h"
#include "engine/viewer/light_ball_picture.h"
#include "engine/viewer/panels.h"
#include "engine/viewer/placed_picture.h"
#include "engine/viewer/screenshots.h"
#include "engine/viewer/session_input.h"
#include "engine/viewer/ui_pass.h"
#include "engine/viewer/view_pictures.h"
#include "engine/viewer/window_layout.h"
#include "engine/viewer/window_picture.h"

namespace nacre {
namespace {

constexpr double kProgressSeconds = 0.1; // between looks at what is loading
constexpr double kRestSeconds = 0.25;    // after which what is held counts as still
constexpr double kLeastWait = 1e-3;
constexpr double kTitleSeconds = 0.25; // between changes of the title while frames follow each other
constexpr glm::vec3 kBackground{0.11f, 0.11f, 0.12f};

// Frames: what has happened since the last, what was read, and then pictures and panels, as often as anything changes.
class ViewerWindow {
public:
    // The state's captured lights are resolved, and what it shows can be shown.
    ViewerWindow(const Context& context, ViewState state, Choices choices, const SceneSource& source,
                 const ViewerOptions& options);
    // Until it is closed.
    void run();

private:
    double waitingTime() const;
    void passTime();
    void takeEvents(const WindowEvents& events);
    void takeWhatWasRead();
    void takeScene(const ViewState& state, const LoadedScene& scene);
    void keepThumbnail();
    void keepShown();
    void noteRecent();
    void openRecent();
    void followScale();
    void takeScreenshot();
    void applyState();
    void drawFrame();
    void drawPictures();
    const Photographs* photographs() const;
    std::optional<SeenPart> seenPart() const;
    void placePicture(const Stage& stage);
    void describePanels(const Stage& stage);
    void showTitle();
    WindowLayout layout() const;
    Stage stage() const;

    const Context& context_;
    const SceneSource& source_;
    ViewerOptions options_;
    Window window_;
    Swapchain swapchain_;
    WindowPicture windowPicture_;
    std::optional<UiPass> ui_;
    ViewPictures pictures_;
    LightBallPicture lightBall_;
    const Texture* ball_ = nullptr; // drawn in this frame
    PhotographComparison comparison_;
    std::map<std::string, Texture> thumbnails_;
    std::map<std::filesystem::path, Texture> shapes_; // thumbnails of those that have been shown
    std::optional<std::filesystem::path> shape_;      // TargetChoice::path of the one that is
    bool hasThumbnail_ = false;                       // since it is
    std::optional<SeenPart> seen_;                    // of the renders, as they were drawn
    std::vector<PlacedPicture> placed_;

    SessionInput input_;
    Session& session_;
    glm::vec3 view_{0, 0, 1};

    FramePace pace_;
    bool rests_ = false; // the mouse, while it holds a light or the object
    std::string remark_; // on the picture that was last at rest
    Stopwatch sinceTitle_;
    Stopwatch sinceOpened_, sinceEvents_;
    OpeningHint hint_;
    float drawnHint_ = 1; // its opacity, as it was drawn

    BackgroundLoads loads_;
    RecentFiles recent_;
};

ViewerWindow::ViewerWindow(const Context& context, ViewState state, Choices choices, const SceneSource& source,
                           const ViewerOptions& options)
    : context_(context), source_(source), options_(options), window_("nacre", options.width, options.height),
      swapchain_(context, window_), windowPicture_(context), pictures_(context), lightBall_(context),
      comparison_(context), input_(std::move(state), std::move(choices)), session_(input_.session),
      loads_(source, session_.state, Window::wake), recent_(options.recent)
{
    session_.textScale = std::clamp(options.textScale, kLeastTextScale, kMostTextScale);
    followScale();
    view_ = viewDirectionOf(session_.state);
    takeScene(session_.state, loadScene(source_, session_.state, input_.choices, {}, {}));
    requireResidual(pictures_.scene().main->surface, view_, session_.state.residual);
    applyState();
    session_.opened = session_.state;
    noteRecent();
}

void ViewerWindow::run()
{
    while (!session_.wantsToQuit && !window_.shouldClose()) {
        pace_.wait();
        takeEvents(window_.waitForEvents(waitingTime()));
        takeWhatWasRead();
        loads_.follow(session_.state, input_.choices, pictures_.scene());
        if (session_.wantsScreenshot) {
            takeScreenshot();
        }
        followScale();
        const glm::ivec2 size = window_.framebufferSize();
        if (!swapchain_.isEmpty() && size.x > 0 && size.y > 0 && pace_.isDue()) {
            drawFrame();
        }
    }
    fmt::print("showed       {} pictures\n", pace_.drawn());
}

// 0 while something moves; negative where nothing does until something happens. What presents a frame wakes the window
// as well, so that what is due by time is so by the clock.
double ViewerWindow::waitingTime() const
{
    if (swapchain_.isEmpty()) {
        return -1;
    }
    if (pace_.isDue()) {
        return 0;
    }
    double wait = std::numeric_limits<double>::infinity();
    if (loads_.busy() != nullptr) {
        wait = kProgressSeconds - pace_.sinceFrame();
    }
    if (pictures_.isMoving()) {
        wait = std::min(wait, kRestSeconds - sinceEvents_.seconds());
    }
    if (drawnHint_ > 0) {
        wait = std::min(wait, hint_.rest(sinceOpened_.seconds()));
    }
    return std::isfinite(wait) ? std::max(wait, kLeastWait) : -1;
}

void ViewerWindow::passTime()
{
    const bool isStill = pictures_.isMoving() && sinceEvents_.seconds() >= kRestSeconds;
    rests_ = rests_ || (isStill && !pace_.isDue());
    const bool hasProgress = loads_.busy() != nullptr && pace_.sinceFrame() >= kProgressSeconds;
    if (isStill || hasProgress || hint_.opacity(sinceOpened_.seconds()) != drawnHint_) {
        pace_.ask(1);
    }
}

void ViewerWindow::takeEvents(const WindowEvents& events)
{
    if (!events.any) {
        passTime();
        return;
    }
    sinceEvents_.lap();
    pace_.settle();
    rests_ = false;
    if (!events.keys.empty() || events.pressed[0] || events.pressed[1] || events.pressed[2]) {
        hint_.leave(sinceOpened_.seconds());
    }
    if (events.resized) {
        swapchain_.rebuild();
    }
    if (swapchain_.isEmpty()) {
        return;
    }
    if (const std::optional<std::filesystem::path> surface = input_.take(events, window_, stage())) {
        loads_.open(*surface);
    }
}

void ViewerWindow::takeWhatWasRead()
{
    const BackgroundLoads::Done done = loads_.finish(input_.choices);
    if (done.scene && done.scene->choices) {
        input_.choices = *done.scene->choices;
        thumbnails_.clear();
        shapes_.clear();
        windowPicture_.forget();
        hasThumbnail_ = false;
        pictures_.setPhotographs(nullptr);
        takeScene(done.scene->state, done.scene->scene);
        session_ = {.state = done.scene->state,
                    .textScale = session_.textScale,
                    .canTurn = session_.canTurn,
                    .lightsFollow = session_.lightsFollow,
                    .hasResidual = session_.hasResidual,
                    .wantsScreenshot = session_.wantsScreenshot};
        applyState();
        session_.opened = session_.state;
        noteRecent();
    } else if (done.scene) {
        takeScene(done.scene->state, done.scene->scene);
    } else if (done.photographs) {
        pictures_.setPhotographs(loads_.photographs());
        session_.hasPhotographs = loads_.shown().onto.empty() && !loads_.shown().surface.empty();
    } else if (!done.problem.empty()) {
        session_.message = done.problem;
        keepShown();
    }
    if (done.material) {
        const auto& [specification, material] = *done.material;
        thumbnails_.insert_or_assign(
            specification, uploadPicture(context_, materialThumbnail(context_, *material, layout().thumbnailSize())));
    }
    if (done.scene || done.photographs || done.material) {
        pace_.settle();
    }
}

// Of the shape that is shown, from the picture that was drawn last.
void ViewerWindow::keepThumbnail()
{
    hasThumbnail_ = true;
    if (!shape_ || session_.state.show != Show::picture || session_.state.framing != Framing()) {
        return;
    }
    const Image picture = readCodes(context_, pictures_.main());
    const int longer = std::max(picture.width, picture.height);
    const float scale = std::min(1.0f, static_cast<float>(layout().shapeSize()) / static_cast<float>(longer));
    const Image small = reducedCodes(picture, wholeZoom(picture.width, picture.height, scale));
    shapes_.insert_or_assign(*shape_, uploadPicture(context_, small));
}

void ViewerWindow::takeScene(const ViewState& state, const LoadedScene& scene)
{
    const bool isOtherMaterial = scene.main != pictures_.scene().main;
    if (hasThumbnail_) {
        keepThumbnail(); // as it was left
    }
    pictures_.setScene(scene, state);
    const std::optional<size_t> target = chosenTarget(state, input_.choices);
    shape_ = target ? std::optional(input_.choices.targets[*target].path) : std::nullopt;
    hasThumbnail_ = false;
    if (isOtherMaterial && !scene.main->surface.materials.empty()) {
        lightBall_.setSurface(scene.main->surface);
        input_.pixel.reset();
    }
    input_.settle();
    session_.hasPhotographs = loads_.photographs() != nullptr && state.onto.empty() && !state.surface.empty();
    session_.canTurn = scene.main->mesh != nullptr;
    session_.hasResidual = hasResidualFrom(scene.main->surface, view_);
}

// Of the text and all around it: the screen's, which may change, times the user's.
void ViewerWindow::followScale()
{
    const float scale = session_.textScale * std::max(window_.contentScale(), 1.0f);
    if (!ui_ || ui_->scale() != scale) {
        ui_.reset(); // ImGui is one at a time
        ui_.emplace(context_, window_, swapchain_, scale);
    }
}

void ViewerWindow::noteRecent()
{
    if (!input_.choices.surface.empty()) {
        recent_.note(input_.choices.surface);
    }
}

void ViewerWindow::openRecent()
{
    const std::filesystem::path surface = std::exchange(session_.wantsToOpen, {});
    if (surface.empty()) {
        return;
    }
    if (std::filesystem::is_directory(surface)) {
        loads_.open(surface);
    } else {
        session_.message = fmt::format("{}: is not there any more", surface.string());
    }
    pace_.settle();
}

// Where what was asked for cannot or shall not be read.
void ViewerWindow::keepShown()
{
    input_.goBackTo(loads_.shown());
    loads_.keep(session_.state);
    pace_.settle();
}

// Of what the state shows, in its own size; once it is loaded.
void ViewerWindow::takeScreenshot()
{
    if (loads_.readsScene() || (session_.state.show == Show::verdicts && loads_.readsPhotographs())) {
        return;
    }
    session_.wantsScreenshot = false;
    pictures_.setTurning(false);
    pictures_.setLightsMove(false);
    try {
        applyState();
        const std::filesystem::path file = nextScreenshot(options_.screenshots);
        saveScreenshot(file, pictures_.picture(), session_.state);
        session_.message = fmt::format("wrote {} and its state", file.string());
    } catch (const Error& e) {
        session_.message = e.what();
    }
    pace_.settle();
}

WindowLayout ViewerWindow::layout() const
{
    return {glm::vec2(swapchain_.extent().width, swapchain_.extent().height), ui_->scale()};
}

Stage ViewerWindow::stage() const
{
    return {.window = layout().window,
            .scale = ui_->scale(),
            .area = layout().area(),
            .picture = pictures_.size(),
            .wipeColumn = pictures_.other() != nullptr ? std::optional(pictures_.wipeColumn()) : std::nullopt};
}

void ViewerWindow::applyState()
{
    settleShow(session_);
    pictures_.apply(session_.state, view_, input_.choices.captured);
}

// Of the pixels that are shown, if they are at hand.
const Photographs* ViewerWindow::photographs() const
{
    return session_.state.onto.empty() && session_.state.turn == Turn() ? loads_.photographs() : nullptr;
}

// None where pictures are shown as they are: photographs and what is judged or compared pixel by pixel.
std::optional<SeenPart> ViewerWindow::seenPart() const
{
    const Stage stage = this->stage();
    const Framing framing = resolved(session_.state.framing, stage.picture, stage.area);
    const SeenPart part = nacre::seenPart(stage.picture, framing, stage.area);
    const bool isRender = session_.comparison == Comparison::none && session_.state.show != Show::verdicts;
    return isRender && framing.zoom != 1 && part.zoom.size.x > 0 && part.zoom.size.y > 0 ? std::optional(part)
                                                                                         : std::nullopt;
}

void ViewerWindow::drawPictures()
{
    pictures_.setTurning(input_.isTurning() && !rests_);
    pictures_.setLightsMove(input_.movesLights() && !rests_);
    settleShow(session_);
    seen_ = seenPart();
    pictures_.setZoom(seen_ ? std::optional(seen_->zoom) : std::nullopt);
    applyState();
    session_.hasResidual = hasResidualFrom(pictures_.scene().main->surface, view_); // a turned surface has none
    pictures_.draw();
    if (!pictures_.scene().main->surface.materials.empty()) {
        ball_ = &lightBall_.draw(pictures_, layout().ballSize());
        comparison_.update(session_, photographs(), pictures_);
    }
}

void ViewerWindow::placePicture(const Stage& stage)
{
    const Framing framing = resolved(session_.state.framing, stage.picture, stage.area);
    if (comparison_.picture() != nullptr) {
        placed_.push_back({comparison_.picture(), 0, stage.picture.x, framing, stage.area});
        return;
    }
    const auto place = [&](const Texture& texture) {
        return seen_ ? placedPicture(texture, {seen_->origin, seen_->zoom.size}, stage.area)
                     : PlacedPicture{&texture, 0, stage.picture.x, framing, stage.area};
    };
    PlacedPicture& main = placed_.emplace_back(place(pictures_.main()));
    if (stage.wipeColumn) {
        const int line = seen_ ? columnIn(*seen_, *stage.wipeColumn) : *stage.wipeColumn;
        main.endColumn = line;
        placed_.emplace_back(place(*pictures_.other())).firstColumn = line;
    }
}

void ViewerWindow::describePanels(const Stage& stage)
{
    const DrawnSurface* drawn = pictures_.scene().main.get();
    const PanelInputs inputs{.choices = input_.choices,
                             .thumbnails = thumbnails_,
                             .shapes = shapes_,
                             .ball = drawn->surface.materials.empty() ? nullptr : ball_,
                             .drawn = drawn,
                             .recent = recent_.files(),
                             .photographs = photographs(),
                             .verdicts = pictures_.verdicts(),
                             .pixel = pictures_.isTurning() ? std::nullopt : input_.pixel,
                             .comparisonFigures = comparison_.figures(),
                             .scale = stage.scale,
                             .shapeSize = static_cast<float>(layout().shapeSize())};
    showPanels(session_, inputs, stage, layout().panelWidth(), placed_);
    if (comparison_.picture() == nullptr) {
        showWipeLine(session_, stage);
    }
    const bool isRendered = comparison_.picture() == nullptr &&
                            (session_.state.show == Show::picture || session_.state.show == Show::coverage);
    if (!isRendered) {
        remark_.clear();
    } else if (pictures_.isTurning()) {
        remark_ = "outlines are coarse, and no shadows are cast, while the object turns";
    } else if (pictures_.doLightsMove() && pictures_.renderer().isCoarse()) {
        remark_ = "highlights are coarse while a light moves";
    } else if (!pictures_.isMoving() && !pace_.isDue() &&
               !session_.playing) { // it takes as long as a frame: once nothing moves
        remark_ = describeUncertainShare(pictures_.uncertainShare());
    }
    drawnHint_ = hint_.opacity(sinceOpened_.seconds());
    if (showStatus(session_, loads_.busy(), stage, drawnHint_, remark_)) {
        const bool wasScene = loads_.readsScene();
        session_.message = fmt::format("cancelled {}", loads_.cancel());
        if (wasScene) {
            keepShown();
        }
    }
    if (session_.help) {
        showHelp(stage.window, stage.scale);
    }
}

void ViewerWindow::drawFrame()
{
    pace_.begin();
    drawPictures();
    if (!hasThumbnail_ && !pictures_.isMoving()) {
        keepThumbnail();
    }
    placed_.clear();
    const Stage stage = this->stage();
    placePicture(stage);
    input_.inspect(stage);
    ui_->begin();
    describePanels(stage);
    ui_->end();
    const bool wasShown = swapchain_.show([&](VkCommandBuffer commands, size_t image) {
        windowPicture_.record(commands, swapchain_, image, placed_, kBackground, *ui_);
    });
    if (!wasShown) {
        swapchain_.rebuild();
        pace_.settle();
    }
    pace_.end();
    openRecent();
    showTitle();
    if (session_.playing) {
        play(session_, static_cast<float>(std::max(pace_.seconds(), 1 / FramePace::kMostFramesPerSecond)));
        pace_.ask(1);
    }
}

void ViewerWindow::showTitle()
{
    if (pace_.isDue() && sinceTitle_.seconds() < kTitleSeconds) {
        return; // window managers draw it anew each time
    }
    sinceTitle_.lap();
    const std::filesystem::path& surface = input_.choices.surface;
    const std::string name = surface.empty() ? session_.state.material : surface.stem().string();
    window_.setTitle(
        fmt::format("{} - nacre - {} - {:.1f} ms a frame", name, context_.info().name, 1000 * pace_.seconds()));
}

} // namespace

void runViewer(const Context& context, ViewState state, Choices choices, const SceneSource& source,
               const ViewerOptions& options)
{
    resolveCaptured(state, choices.captured);
    requireShown(state);
    ViewerWindow(context, std::move(state), std::move(choices), source, options).run();
}

} // namespace nacre
