#include "assets/head/statue_head.h"

#include <algorithm>
#include <optional>

#include "assets/head/statue_shape.h"
#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

using glm::vec2;
using glm::vec3;

// The bust fills the picture's height: its middle and half height in the head's units.
constexpr float kMiddleY = -0.50f;
constexpr float kHalfHeight = 1.78f;
constexpr float kNear = 1.3f;
constexpr float kFar = -1.2f;
// Joined shapes, ellipsoids and grooves overstate the distance; this share of it is safe to go.
constexpr float kSafeShare = 0.58f;
constexpr float kSurface = 4e-4f;
constexpr float kGrazing = 4e-3f;
constexpr int kLargestSteps = 600; // a ray along an edge needs them
// For the gradient by differences: a third of a pixel at 512 pixels.
constexpr float kDifference = 1.2e-3f;

struct Statue {
    float turn;
    float bow;

    // The head turns about the top of the neck.
    vec3 inHead(const vec3& p) const
    {
        const vec3 pivot(0, -0.55f, -0.20f);
        vec3 q = p - pivot;
        vec2 turned = rotated({q.x, q.z}, turn);
        vec2 bowed = rotated({q.y, turned.y}, bow);
        return vec3(turned.x, bowed.x, bowed.y) + pivot;
    }

    float distance(const vec3& p) const
    {
        vec3 h = inHead(p);
        float head = joined(faceDistance(h), hairDistance(h), 0.02f);
        return joined(head, bustDistance(p), 0.14f);
    }

    uint8_t part(const vec3& p) const
    {
        constexpr uint8_t kSkin = 0, kHair = 1, kCloak = 2;
        vec3 h = inHead(p);
        float face = faceDistance(h), hair = hairDistance(h), bust = bustDistance(p);
        if (bust < std::min(face, hair)) {
            return onCloak(p) ? kCloak : kSkin;
        }
        return hair < face ? kHair : kSkin;
    }

    // By differences at a tetrahedron's corners.
    vec3 normal(const vec3& p) const
    {
        constexpr vec3 kCorners[] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
        vec3 sum(0);
        for (const vec3& corner : kCorners) {
            sum += corner * distance(p + corner * kDifference);
        }
        return glm::normalize(sum);
    }

    std::optional<vec3> hit(const vec2& p) const
    {
        float z = kNear;
        float d = kNear;
        for (int i = 0; i < kLargestSteps && z > kFar; ++i) {
            d = distance({p, z});
            if (d < kSurface) {
                return vec3(p, z);
            }
            z -= d * kSafeShare;
        }
        // Steps run out where the ray grazes the surface: within half a pixel it counts as met.
        return d < kGrazing ? std::optional(vec3(p, z)) : std::nullopt;
    }
};

// Differences across a sharp edge may point away from the camera that sees the point.
vec3 cameraFacing(const vec3& n)
{
    constexpr float kLeastZ = 0.02f;
    return glm::normalize(vec3(n.x, n.y, std::max(n.z, kLeastZ)));
}

// Samples over the picture's shorter side, about: tracing is dear.
constexpr int kHeadSamples = 768;
constexpr int kMostHeadPerSide = 4; // samples along a pixel's side

struct View {
    int width, height, perPixel;

    // In the bust's frame, in front of sample (i, j) of a pixel.
    vec2 planePoint(size_t pixel, int i, int j) const
    {
        const float halfSide = 0.5f * static_cast<float>(std::min(width, height));
        const vec2 share = (vec2(i, j) + 0.5f) / static_cast<float>(perPixel);
        const float x = static_cast<float>(pixel % width) + share.x - 0.5f * static_cast<float>(width);
        const float y = 0.5f * static_cast<float>(height) - static_cast<float>(pixel / width) - share.y;
        return vec2(x, y) * (kHalfHeight / halfSide) + vec2(0, kMiddleY);
    }
};

// A pixel shows the bust where half of its samples do, and is the mean of those.
void fillPixel(Target& target, size_t pixel, const View& view, const Statue& statue)
{
    vec3 normal(0), mean(0);
    int seen = 0;
    for (int s = 0; s < view.perPixel * view.perPixel; ++s) {
        if (auto p = statue.hit(view.planePoint(pixel, s % view.perPixel, s / view.perPixel))) {
            normal += cameraFacing(statue.normal(*p));
            mean += *p;
            ++seen;
        }
    }
    if (seen == 0 || 2 * seen < view.perPixel * view.perPixel) {
        return;
    }
    mean /= static_cast<float>(seen);
    target.normals.normals[pixel] = glm::normalize(normal);
    target.normals.confidence[pixel] = 1.0f;
    target.height.values[pixel] = mean.z * 0.5f * static_cast<float>(std::min(view.width, view.height)) / kHalfHeight;
    target.labels[pixel] = statue.part(mean);
}

} // namespace

Target statueHead(int width, int height, const StatueHeadOptions& options, int threads)
{
    constexpr float kRadians = 0.0174532925f;
    const Statue statue{static_cast<float>(options.turnDegrees) * kRadians,
                        static_cast<float>(options.bowDegrees) * kRadians};
    const int side = std::min(width, height);
    const View view{width, height, std::clamp((kHeadSamples + side - 1) / side, 1, kMostHeadPerSide)};
    Target target(width, height, {"skin", "hair", "cloak"});
    parallelFor(height, 4, threads, [&](size_t first, size_t last) {
        for (size_t pixel = first * width; pixel < last * width; ++pixel) {
            fillPixel(target, pixel, view, statue);
        }
    });
    return target;
}

} // namespace nacre
