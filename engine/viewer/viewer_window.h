#pragma once
// Inside of runViewer.
#include <chrono>
#include <map>

#include "engine/viewer/dropped_file.h"
#include "engine/viewer/loader.h"
#include "engine/viewer/panels.h"
#include "engine/viewer/ui_pass.h"
#include "engine/viewer/viewer.h"

namespace nacre {

class ViewerWindow {
public:
    // The state's captured lights are resolved, and what it shows can be shown.
    ViewerWindow(const Context& context, ViewState state, Choices choices, const SceneSource& source,
                 const ViewerOptions& options);
    // Until it is closed.
    void run();

private:
    using Clock = std::chrono::steady_clock;
    enum class Drag { none, pan, light, wipe };
    struct Drop { // the lists and the state around one that is being loaded
        Choices choices;
        ViewState before, after;
    };

    // viewer_window.cpp: time and frames
    double waitingTime() const;
    void keepPace();
    void drawFrame();
    void drawPictures();
    void drawComparison();
    void showTitle(double seconds);
    void applyState();
    Area pictureArea() const;
    float panelWidth() const;     // on the right
    float inspectorWidth() const; // on the left
    Framing framing() const;

    // viewer_panels.cpp: what ImGui describes
    void showPanels();
    void showStatus();
    void showWipeLine();
    void placePicture();
    PanelInputs panelInputs();

    // viewer_input.cpp: mouse, keys, dropped files
    void takeEvents(const WindowEvents& events);
    void takeMouse(const WindowEvents& events);
    void drag(const glm::vec2& moved);
    void inspect(const glm::vec2& cursor);
    void drop(const std::filesystem::path& file);
    void choose(Dropped kind, const std::filesystem::path& file);
    void takeScreenshot();

    // viewer_loading.cpp: what is read in the background
    void followState();
    void finishLoading();
    void loadNextThumbnail();
    void loadPhotographs();
    void openSurface(const std::filesystem::path& folder);
    void cancelLoading();
    void keepLoaded();
    void takeScene(const ViewState& state, const LoadedScene& scene);

    const Context& context_;
    const SceneSource& source_;
    ViewerOptions options_;
    Window window_;
    Swapchain swapchain_;
    UiPass ui_;
    ViewPictures pictures_;
    Renderer ball_;
    std::optional<Texture> comparison_;
    std::optional<std::pair<size_t, size_t>> compared_; // its photograph, and the render's number
    Comparison comparedBy_ = Comparison::none;
    std::string comparisonFigures_;

    Session session_;
    Choices choices_;
    glm::vec3 view_{0, 0, 1};
    ViewState loaded_;    // the state that the pictures' scene was loaded for
    ViewState requested_; // the one that is being loaded
    std::optional<Drop> drop_;
    std::optional<Photographs> photographs_;
    bool photographsAreRead_ = false;
    std::map<std::string, Texture> thumbnails_;
    std::map<std::string, bool> triedThumbnails_;

    std::vector<PlacedPicture> placed_;
    std::optional<glm::ivec2> pixel_;
    Drag drag_ = Drag::none;
    glm::vec2 cursor_{0, 0};
    int framesLeft_ = 3; // ImGui settles over a few frames
    Clock::time_point lastFrame_ = Clock::now();
    double frameSeconds_ = 0; // of one, smoothed
    size_t shownFrames_ = 0;

    Loader sceneLoader_{Window::wake}; // gone first: its jobs refer to what is above
    Loader photographLoader_{Window::wake};
    Loader thumbnailLoader_{Window::wake};
};

} // namespace nacre
