#include "acquisition/brdf/light_slices.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/files/lanes.h"

namespace nacre {

namespace {

const glm::vec3 kTowardsCamera(0, 0, 1);

// Abramowitz and Stegun, Handbook of Mathematical Functions, 1964, 4.4.49: arctan(x) / x in x^2, to 2e-8 on [0,1].
constexpr float kArctangent[] = {0.0028662257f,  -0.0161657367f, 0.0429096138f,
                                 -0.0752896400f, 0.1065626393f,  -0.1420889944f,
                                 0.1999355085f,  -0.3333314528f, 1};

// atan2(y, x) over pi / 2 where both are at least 0; 0 where both are 0.
NACRE_ON_LANES Lanes quadrantShare(const Lanes& y, const Lanes& x)
{
    const auto isSteep = y > x;
    const Lanes larger = isSteep ? y : x, smaller = isSteep ? x : y;
    const Lanes ratio = smaller / (larger > 1e-30f ? larger : allLanes(1e-30f)), square = ratio * ratio;
    Lanes sum = {};
    for (const float coefficient : kArctangent) {
        sum = sum * square + coefficient;
    }
    const Lanes share = sum * ratio * (1 / kHalfPi);
    return isSteep ? 1 - share : share;
}

// Coordinates of (thetaH, phiD) in [0,1]. Reciprocity folds phiD to [0, pi/2]; one way it is pi less that where the
// normal leans towards the light (light_frame.h).
NACRE_VECTOR_CLONES
void sliceCoordinates(const std::vector<float>* axes, const glm::vec3& n, bool isOneWay, float* halves, float* azimuths)
{
    for (size_t i = 0; i < axes[0].size(); i += kLanes) {
        Lanes along[3];
        for (int axis = 0; axis < 3; ++axis) {
            along[axis] = n.x * lanesAt(&axes[3 * axis][i]) + n.y * lanesAt(&axes[3 * axis + 1][i]) +
                          n.z * lanesAt(&axes[3 * axis + 2][i]);
        }
        const Lanes aside = rootOf(along[0] * along[0] + along[1] * along[1]);
        const Lanes half = rootOf(quadrantShare(aside, absolute(along[2]))),
                    folded = quadrantShare(absolute(along[1]), absolute(along[0]));
        const Lanes azimuth = !isOneWay ? folded : along[0] > 0 ? 1 - folded / 2 : folded / 2;
        for (int k = 0; k < kLanes; ++k) {
            halves[i + k] = half[k];
            azimuths[i + k] = azimuth[k];
        }
    }
}

} // namespace

LightSlices::LightSlices(const BrdfTable& table, std::span<const Light> lights)
    : size_(table.size.x, table.size.z), isOneWay_(table.domain.coordinates == kOneWay), lightCount_(lights.size())
{
    for (std::vector<float>& component : axes_) {
        component.assign((lights.size() + kLanes - 1) / kLanes * kLanes, 0.0f);
    }
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3 sum = lights[i].direction + kTowardsCamera, difference = lights[i].direction - kTowardsCamera;
        const glm::vec3 h = glm::normalize(sum);
        const float apart = glm::length(difference);
        const glm::vec3 t = apart > 0 ? difference / apart : anyPerpendicular(h), b = glm::cross(h, t);
        for (int c = 0; c < 3; ++c) {
            axes_[c][i] = t[c];
            axes_[3 + c][i] = b[c];
            axes_[6 + c][i] = h[c];
        }
        const float place = std::clamp(std::atan2(apart, glm::length(sum)) / table.domain.thetaDMax, 0.0f, 1.0f) *
                            static_cast<float>(table.size.y - 1);
        const int low = static_cast<int>(place), high = std::min(low + 1, table.size.y - 1);
        for (int azimuth = 0; azimuth < size_.y; ++azimuth) {
            const int k = apart > 0 ? azimuth : 0; // where phiD is not defined, it is 0
            for (int half = 0; half < size_.x; ++half) {
                slices_.push_back(glm::mix(table.values[table.index(half, low, k)],
                                           table.values[table.index(half, high, k)], place - static_cast<float>(low)));
            }
        }
    }
}

void LightSlices::evaluate(const glm::vec3& normal, std::span<glm::vec3> values) const
{
    thread_local std::vector<float> halves, azimuths;
    halves.resize(axes_[0].size());
    azimuths.resize(axes_[0].size());
    sliceCoordinates(axes_, normal, isOneWay_, halves.data(), azimuths.data());
    const glm::vec3* slice = slices_.data();
    for (size_t i = 0; i < lightCount_; ++i, slice += static_cast<size_t>(size_.x) * size_.y) {
        const float x = std::min(halves[i], 1.0f) * static_cast<float>(size_.x - 1),
                    y = std::min(azimuths[i], 1.0f) * static_cast<float>(size_.y - 1);
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const int right = column + 1 < size_.x ? 1 : 0, below = row + 1 < size_.y ? size_.x : 0;
        const glm::vec3* texel = slice + row * size_.x + column;
        const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
        values[i] =
            (1 - v) * ((1 - u) * texel[0] + u * texel[right]) + v * ((1 - u) * texel[below] + u * texel[below + right]);
    }
}

} // namespace nacre
