#pragma once
#include "engine/view_state/choices.h"

namespace nacre {

// What lit the scene before, for undo and redo.
class LightHistory {
public:
    // Keeps what has changed since; while `moves` (a drag, a light path that plays) nothing, so that it is one step.
    void follow(const ViewState& state, bool moves);
    // False where there is nothing to go back, or forward, to.
    bool undo(ViewState& state) { return step(past_, future_, state); }
    bool redo(ViewState& state) { return step(future_, past_, state); }

private:
    struct Lit {
        std::vector<LightSource> lights;
        std::filesystem::path environment;
        float environmentTurn = 0;
        bool operator==(const Lit&) const = default;
    };
    static Lit litBy(const ViewState& state);
    bool step(std::vector<Lit>& from, std::vector<Lit>& to, ViewState& state);

    std::optional<Lit> now_;
    std::vector<Lit> past_, future_;
};

} // namespace nacre
