#include "engine/view_state/opening_hint.h"

#include <algorithm>

namespace nacre {

void OpeningHint::leave(double now)
{
    fadesAt_ = std::min(fadesAt_, now);
}

float OpeningHint::opacity(double now) const
{
    return static_cast<float>(std::clamp(1 - (now - fadesAt_) / kFadeSeconds, 0.0, 1.0));
}

double OpeningHint::rest(double now) const
{
    return std::max(fadesAt_ - now, kStepSeconds);
}

} // namespace nacre
