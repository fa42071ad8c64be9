#include "assets/head/distance_shapes.h"
#include "assets/head/statue_shape.h"

namespace nacre {
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
