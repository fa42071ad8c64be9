#include <array>

#include "assets/head/distance_shapes.h"
#include "assets/head/statue_shape.h"

namespace nacre {
namespace {

using glm::vec2;
using glm::vec3;

// The cap of hair: locks comb out from the whorl at the crown and wave on their way.
const vec3 kCapMiddle(0, 0.36f, -0.14f);
const vec3 kCapRadii(0.735f, 0.735f, 0.87f);
const vec3 kWhorl = glm::normalize(vec3(0.08f, 0.90f, -0.42f));

float locks(const vec3& p)
{
    vec3 d = glm::normalize((p - kCapMiddle) / kCapRadii);
    vec3 side = glm::normalize(glm::cross(kWhorl, vec3(0, 0, 1)));
    vec3 front = glm::cross(side, kWhorl);
    float fromWhorl = std::acos(glm::clamp(glm::dot(d, kWhorl), -1.0f, 1.0f));
    float azimuth = std::atan2(glm::dot(d, side), glm::dot(d, front));
    float wave = azimuth + 0.11f * std::sin(7.5f * fromWhorl + 2.0f * std::sin(azimuth * 3.0f));
    float broad = std::sin(17.0f * wave + 0.8f * std::sin(4.0f * fromWhorl));
    float fine = std::sin(51.0f * wave + 3.0f * std::sin(6.0f * fromWhorl));
    float spread = glm::clamp(std::sin(fromWhorl) * 1.6f, 0.0f, 1.0f); // lines crowd at the whorl
    return spread * (0.028f * broad + 0.009f * fine);
}

// One snail curl of the antique fringe: a boss with a spiral groove, in its own axes.
struct Curl {
    vec3 middle, x, y, outwards;
    float size;
    float turn; // where the spiral starts; its sign says which way it winds
};

float curlDistance(const vec3& p, const Curl& c)
{
    vec3 q = p - c.middle;
    float apart = glm::length(q) - c.size * 1.3f;
    if (apart > 0.06f) {
        return apart;
    }
    vec3 local(glm::dot(q, c.x), glm::dot(q, c.y), glm::dot(q, c.outwards));
    float boss = ellipsoid(local, {c.size, c.size, c.size * 0.75f});
    float radius = glm::length(vec2(local)) / c.size;
    float angle = std::atan2(local.y, local.x) * (c.turn > 0 ? 1.0f : -1.0f) + c.turn;
    float spiral = std::cos(angle + 12.5f * radius);
    return boss - 0.14f * c.size * spiral * glm::clamp(radius * 3.0f, 0.3f, 1.0f);
}

// `t` runs from temple to temple, -1 to 1; the row sags towards the temples and lies on the cap.
Curl curlOfRow(float t, float height, float size, float reach, float turn)
{
    float azimuth = reach * t;
    float y = height - 0.30f * t * t * t * t - 0.06f * t * t;
    float v = (y - kCapMiddle.y) / kCapRadii.y;
    float ring = std::sqrt(std::max(0.0f, 1.0f - v * v));
    vec3 onCap = kCapMiddle + kCapRadii * vec3(ring * std::sin(azimuth), v, ring * std::cos(azimuth));
    vec3 outwards = glm::normalize(vec3(std::sin(azimuth) / kCapRadii.x, v * 0.6f, std::cos(azimuth) / kCapRadii.z));
    vec3 x = glm::normalize(glm::cross(vec3(0, 1, 0), outwards));
    return {onCap - 0.02f * outwards, x, glm::cross(outwards, x), outwards, size, turn};
}

constexpr int kLowerCurls = 9;
constexpr int kUpperCurls = 8;

std::array<Curl, kLowerCurls + kUpperCurls> makeFringe()
{
    std::array<Curl, kLowerCurls + kUpperCurls> curls;
    auto turnOf = [](int i) { return (i % 2 == 0 ? 1.0f : -1.0f) * (0.6f + 0.37f * i); };
    for (int i = 0; i < kLowerCurls; ++i) {
        curls[i] = curlOfRow(2.0f * i / (kLowerCurls - 1) - 1.0f, 0.555f, 0.112f, 1.38f, turnOf(i));
    }
    for (int i = 0; i < kUpperCurls; ++i) {
        curls[kLowerCurls + i] = curlOfRow(2.0f * i / (kUpperCurls - 1) - 1.0f, 0.705f, 0.105f, 1.20f, turnOf(i));
    }
    return curls;
}

float fringe(const vec3& p)
{
    static const auto kFringe = makeFringe();
    float d = 1e3f;
    for (const Curl& curl : kFringe) {
        d = joined(d, curlDistance(p, curl), 0.012f);
    }
    return d;
}

} // namespace

float hairDistance(const vec3& p)
{
    float cap = ellipsoid(p - kCapMiddle, kCapRadii);
    if (cap > 0.40f) {
        return cap - 0.20f; // curls rise less than that above the cap
    }
    // Below this line from the forehead over the ears to the nape there is skin.
    float azimuth = std::atan2(std::abs(p.x), p.z - kCapMiddle.z);
    float hairline =
        0.52f - 0.62f * glm::smoothstep(0.55f, 1.35f, azimuth) - 0.45f * glm::smoothstep(1.7f, 2.5f, azimuth);
    cap = common(cap - locks(p), (hairline - p.y) * 0.8f, 0.06f);
    return joined(cap, fringe(p), 0.03f);
}

} // namespace nacre
