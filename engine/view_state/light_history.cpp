#include "engine/view_state/light_history.h"

namespace nacre {

LightHistory::Lit LightHistory::litBy(const ViewState& state)
{
    return {state.lights, state.environment, state.environmentTurn};
}

void LightHistory::follow(const ViewState& state, bool moves)
{
    Lit lit = litBy(state);
    if (moves || lit == now_) {
        return;
    }
    if (now_) {
        past_.push_back(std::move(*now_));
        future_.clear();
    }
    now_ = std::move(lit);
}

bool LightHistory::step(std::vector<Lit>& from, std::vector<Lit>& to, ViewState& state)
{
    follow(state, false);
    if (from.empty()) {
        return false;
    }
    to.push_back(std::move(*now_));
    now_ = std::move(from.back());
    from.pop_back();
    state.lights = now_->lights;
    state.environment = now_->environment;
    state.environmentTurn = now_->environmentTurn;
    return true;
}

} // namespace nacre
