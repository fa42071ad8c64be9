#include "acquisition/cast_shadows/lit_grid.h"

namespace nacre {

namespace {

// n.l below which the surface faces away, and from which a shadow is surely cast by something else: between them an
// error of the normal decides.
constexpr float kFacesAway = 0.02f, kSurelyFacing = 0.1f;
// Of the predicted radiance: shadows show less, lit pixels more. Light that the object throws on itself fills shadows
// by a third, and BRDFs err by less.
constexpr float kDark = 0.5f, kLit = 0.7f;

} // namespace

LightState lightStateOf(float cosine, float seen, float predicted)
{
    const bool isDark = seen < kDark * predicted;
    if (cosine <= kFacesAway) {
        return LightState::away;
    }
    if (cosine < kSurelyFacing) {
        return isDark ? LightState::away : LightState::unknown;
    }
    return isDark ? LightState::cast : seen > kLit * predicted ? LightState::lit : LightState::unknown;
}

} // namespace nacre
