#pragma once
#include "engine/view_state/controls.h"
#include "engine/view_state/dropped_file.h"
#include "engine/viewer/window.h"

namespace nacre {

// Where in the window what lies, in framebuffer pixels; what mouse positions are read by.
struct Stage {
    glm::vec2 window{0, 0};
    float scale = 1; // pixels a unit of layout
    Area area;       // what panels and the status line leave for the picture
    glm::ivec2 picture{0, 0};
    std::optional<int> wipeColumn; // of the picture, where another stands right of it
};

// A session, what it may choose from, and what mouse, keys and dropped files do to both.
class SessionInput {
public:
    SessionInput(ViewState state, Choices choices);

    Session session;
    Choices choices;
    std::optional<glm::ivec2> pixel; // under the cursor, or the last that was

    // Answers the surface that was dropped, if one was.
    std::optional<std::filesystem::path> take(const WindowEvents& events, const Window& window, const Stage& stage);

    bool isTurning() const { return drag_ == Drag::turn; }
    // By a button that is held, or by the light path that plays.
    bool movesLights() const { return movesLights_; }
    // What the cursor is on, as the picture lies now.
    void inspect(const Stage& stage);
    // What was asked for is shown: a drop cannot be undone any more.
    void settle() { undo_.reset(); }
    // What is shown stays, and so does what the state says of it; what was dropped since leaves the lists again.
    void goBackTo(const ViewState& shown);

private:
    enum class Drag { none, pan, light, wipe, turn };
    struct Undo { // the lists and the state around a drop that is not shown yet
        Choices choices;
        ViewState before, after;
    };

    void takeMouse(const WindowEvents& events, const Window& window, const Stage& stage);
    void drag(const glm::vec2& moved, const Stage& stage);
    void choose(Dropped kind, const std::filesystem::path& file);
    Framing framing(const Stage& stage) const;

    // Where a button was pressed, if one was.
    void begin(const WindowEvents& events, const Window& window, const Stage& stage);

    Drag drag_ = Drag::none;
    int dragButton_ = 0;
    glm::vec2 cursor_{0, 0};
    bool isHeld_ = false;             // a button, when events were last taken
    std::vector<LightSource> atRest_; // lights when none was
    bool movesLights_ = false;
    std::optional<Undo> undo_;
};

} // namespace nacre
