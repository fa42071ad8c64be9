#include "assets/head/statue_shape.h"

#include <array>

namespace nacre {

namespace {

using glm::vec3;

// q is p with x folded to the positive half.

float skull(const vec3& q)
{
    float d = ellipsoid(q - vec3(0, 0.36f, -0.14f), {0.66f, 0.66f, 0.80f});
    d = joined(d, ellipsoid(q - vec3(0, -0.10f, 0.20f), {0.50f, 0.62f, 0.47f}), 0.18f);
    d = joined(d, ellipsoid(q - vec3(0, -0.46f, 0.25f), {0.36f, 0.40f, 0.41f}), 0.14f);            // muzzle
    d = joined(d, limb(q, {0.47f, -0.30f, -0.06f}, {0.17f, -0.76f, 0.38f}, 0.11f, 0.09f), 0.16f);  // jaw bone
    d = joined(d, limb(q, {0.48f, -0.05f, -0.22f}, {0.40f, -0.36f, -0.14f}, 0.17f, 0.10f), 0.14f); // behind the ear
    d = joined(d, ellipsoid(q - vec3(0, -0.80f, 0.48f), {0.16f, 0.12f, 0.13f}), 0.14f);            // chin
    d = joined(d, ellipsoid(q - vec3(0.34f, -0.07f, 0.43f), {0.17f, 0.13f, 0.13f}), 0.18f);        // cheek bone
    return d;
}

float brow(const vec3& q)
{
    float inner = limb(q, {0.08f, 0.215f, 0.625f}, {0.28f, 0.27f, 0.575f}, 0.045f, 0.05f);
    float outer = limb(q, {0.28f, 0.27f, 0.575f}, {0.47f, 0.16f, 0.40f}, 0.05f, 0.045f);
    return joined(inner, outer, 0.05f);
}

float nose(const vec3& q)
{
    float bridge = limb(q, {0, 0.24f, 0.615f}, {0, -0.15f, 0.825f}, 0.056f, 0.060f);
    float tip = ellipsoid(q - vec3(0, -0.195f, 0.815f), {0.078f, 0.066f, 0.080f});
    float side = limb(q, {0.040f, 0.10f, 0.55f}, {0.075f, -0.17f, 0.665f}, 0.055f, 0.062f);
    float wing = ellipsoid(q - vec3(0.098f, -0.222f, 0.708f), {0.050f, 0.054f, 0.080f});
    float d = joined(joined(bridge, tip, 0.07f), side, 0.11f);
    d = joined(d, wing, 0.045f);
    return carved(d, ellipsoid(q - vec3(0.052f, -0.285f, 0.745f), {0.030f, 0.034f, 0.055f}), 0.025f);
}

const vec3 kEye(0.235f, 0.080f, 0.452f);

// A ball between two lids: shells about it, cut by planes that leave the almond free.
float eye(const vec3& q)
{
    vec3 e = q - kEye;
    float ball = sphere(e, 0.128f);
    float shell = sphere(e, 0.152f);
    float tilt = 0.10f * (e.x - 0.02f); // the outer corner lies a little higher
    float almond = 0.052f - 2.6f * (e.x - 0.005f) * (e.x - 0.005f);
    float upper = common(shell, almond - (e.y - tilt), 0.012f);
    float lower = common(shell - 0.002f, (e.y - tilt) + almond * 0.78f, 0.012f);
    return joined(joined(upper, lower, 0.01f), ball, 0.006f);
}

float lipCurve(float x)
{
    return -0.515f + 0.030f * std::cos(9.0f * x) - 0.035f * x;
}

// How far the mouth recedes as it bends around the teeth.
float mouthDepth(float x)
{
    return 0.645f - 1.3f * x * x;
}

float mouth(const vec3& q, float face)
{
    float z = mouthDepth(q.x);
    float upper = ellipsoid(q - vec3(0.060f, -0.452f, z), {0.105f, 0.040f, 0.070f});
    float bow = ellipsoid(q - vec3(0, -0.470f, z + 0.012f), {0.040f, 0.032f, 0.060f});
    float lower = ellipsoid(q - vec3(0.030f, -0.558f, z - 0.008f), {0.115f, 0.048f, 0.072f});
    float lips = joined(joined(upper, bow, 0.03f), lower, 0.012f);
    float d = joined(face, lips, 0.04f);
    float across = q.y - lipCurve(q.x);
    float gape = 0.010f - 0.25f * q.x * q.x; // closes at the corners
    float slit = std::max(std::abs(across) - gape, z - 0.02f - q.z);
    d = carved(d, slit, 0.025f);
    d = carved(d, ellipsoid(q - vec3(0.225f, -0.515f, 0.600f), {0.024f, 0.028f, 0.040f}), 0.11f); // corner
    d = carved(d, ellipsoid(q - vec3(0, -0.365f, 0.715f), {0.026f, 0.060f, 0.030f}), 0.04f);      // philtrum
    return carved(d, ellipsoid(q - vec3(0, -0.655f, 0.640f), {0.130f, 0.042f, 0.060f}), 0.08f);   // under the lip
}

float ear(const vec3& q)
{
    vec3 e = q - vec3(0.640f, 0.02f, -0.08f);
    e = vec3(e.x, rotated({e.y, e.z}, 0.20f));
    float d = ellipsoid(e, {0.070f, 0.185f, 0.125f});
    d = carved(d, ellipsoid(e - vec3(0.070f, 0.035f, 0.015f), {0.055f, 0.130f, 0.080f}), 0.025f);
    d = carved(d, ellipsoid(e - vec3(0.050f, -0.030f, 0.045f), {0.060f, 0.055f, 0.050f}), 0.03f);
    float lobe = ellipsoid(e - vec3(0.000f, -0.150f, 0.035f), {0.042f, 0.050f, 0.046f});
    return joined(d, lobe, 0.04f);
}

} // namespace

float faceDistance(const vec3& p)
{
    vec3 q(foldedX(p.x), p.y, p.z);
    float d = skull(q);
    if (d > 0.45f) {
        return d - 0.25f; // nose and ears rise less than that above the skull
    }
    d = joined(d, brow(q), 0.08f);
    d = carved(d, ellipsoid(q - vec3(0.245f, 0.085f, 0.70f), {0.175f, 0.105f, 0.185f}), 0.09f); // socket
    d = joined(d, nose(q), 0.05f);
    d = joined(d, eye(q), 0.02f);
    d = mouth(q, d);
    return joined(d, ear(q), 0.07f);
}

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

namespace {

using glm::vec3;

float neck(const vec3& p, const vec3& q)
{
    float d = limb(p, {0, -0.45f, -0.22f}, {0, -1.55f, -0.30f}, 0.36f, 0.42f);
    d = joined(d, limb(q, {0.36f, -0.50f, -0.28f}, {0.07f, -1.42f, 0.10f}, 0.085f, 0.060f), 0.12f); // sternomastoid
    d = joined(d, ellipsoid(p - vec3(0, -1.02f, 0.10f), {0.05f, 0.09f, 0.05f}), 0.14f);             // larynx
    d = joined(d, limb(q, {0.16f, -0.95f, -0.40f}, {0.85f, -1.62f, -0.34f}, 0.24f, 0.20f), 0.22f);  // trapezius
    return carved(d, ellipsoid(p - vec3(0, -1.47f, 0.165f), {0.055f, 0.07f, 0.07f}), 0.08f);        // jugular pit
}

float chest(const vec3& q)
{
    float d = ellipsoid(q - vec3(0, -1.98f, -0.30f), {1.02f, 0.46f, 0.46f});
    d = joined(d, sphere(q - vec3(0.98f, -1.84f, -0.34f), 0.30f), 0.20f);
    d = joined(d, limb(q, {0.10f, -1.52f, 0.12f}, {0.85f, -1.56f, -0.08f}, 0.050f, 0.055f), 0.12f); // collar bone
    return joined(d, ellipsoid(q - vec3(0.40f, -2.06f, 0.02f), {0.42f, 0.26f, 0.20f}), 0.14f);      // breast
}

// A cloak fastened on the left shoulder, its folds fanning down across the chest.
float cloak(const vec3& p, float body)
{
    glm::vec2 fromClasp = glm::vec2(p.x, p.y) - glm::vec2(0.95f, -1.30f);
    float angle = std::atan2(fromClasp.y, fromClasp.x);
    float away = glm::length(fromClasp);
    float folds =
        std::sin(26.0f * angle + 1.2f * std::sin(4.0f * away)) * 0.6f + std::sin(41.0f * angle + 2.0f) * 0.25f;
    float shell = body - 0.085f - 0.038f * folds * glm::smoothstep(0.1f, 0.6f, away);
    float edge = glm::dot(glm::vec2(p.x, p.y) - glm::vec2(-0.62f, -1.92f), glm::normalize(glm::vec2(-0.36f, 1.0f)));
    edge += 0.10f * std::sin(2.6f * p.x + 0.5f);
    return common(shell, edge * 0.9f, 0.05f);
}

float bodyDistance(const vec3& p)
{
    vec3 q(foldedX(p.x), p.y, p.z);
    return joined(neck(p, q), chest(q), 0.18f);
}

} // namespace

bool onCloak(const vec3& p)
{
    float body = bodyDistance(p);
    return cloak(p, body) < body;
}

float bustDistance(const vec3& p)
{
    float d = bodyDistance(p);
    if (d > 0.45f) {
        return d - 0.25f; // folds rise less than that above the body
    }
    d = joined(d, cloak(p, d), 0.015f);
    // The bust ends in the bow of a herm.
    float bow = glm::length(glm::vec2(p.x * 0.80f, p.y + 0.95f)) - 1.12f;
    return common(d, bow, 0.04f);
}

} // namespace nacre
