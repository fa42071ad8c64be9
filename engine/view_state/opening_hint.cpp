#include "engine/view_state/opening_hint.h"

#include <algorithm>
#include <cmath>

namespace nacre {

void OpeningHint::leave(double now)
{
    fadesAt_ = std::min(fadesAt_, now);
}

float OpeningHint::opacity(double now) const
{
    const double left = std::clamp(kFadeSeconds - (now - fadesAt_), 0.0, kFadeSeconds);
    return static_cast<float>(std::ceil(left / kStepSeconds) * kStepSeconds / kFadeSeconds);
}

double OpeningHint::rest(double now) const
{
    return std::max(fadesAt_ - now, kStepSeconds);
}

} // namespace nacre
