#include "acquisition/cast_shadows/lit_grid.h"

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

constexpr double kNearestPoint = 1e-3; // 1 + z / d of the lowest point that is told from the infinitely far

// n.l below which the surface faces away, and from which a shadow is surely cast by something else: between them an
// error of the normal decides.
constexpr float kFacesAway = 0.02f, kSurelyFacing = 0.1f;
// Of the predicted radiance: shadows show less, lit pixels more. Light that the object throws on itself fills shadows
// by a third, and BRDFs err by less.
constexpr float kDark = 0.5f, kLit = 0.7f;

} // namespace

bool isPlaced(const LitGrid& grid)
{
    return std::isfinite(grid.cameraDistance) ||
           std::any_of(grid.lights.begin(), grid.lights.end(), [](const glm::vec4& light) { return light.w != 0; });
}

double sceneHeight(const LitGrid& grid, double q)
{
    const double d = grid.cameraDistance;
    return std::isfinite(d) ? d * std::expm1(q / d) : q;
}

double normalsHeight(const LitGrid& grid, double z)
{
    const double d = grid.cameraDistance;
    return std::isfinite(d) ? d * std::log1p(std::max(z / d, kNearestPoint - 1)) : z;
}

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
