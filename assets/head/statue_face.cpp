#include "assets/head/distance_shapes.h"
#include "assets/head/statue_shape.h"

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

} // namespace nacre
