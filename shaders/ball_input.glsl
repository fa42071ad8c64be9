// What shaders that draw pictures from balls read.
layout(constant_id = kConstantModulated) const bool kModulated = false;
layout(constant_id = kConstantToneCurve) const int kToneCurve = kToneSrgb;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingInput) uniform sampler2D balls;
layout(scalar, push_constant) uniform Constants
{
    BallConstants constants;
};

struct BallPixel {
    bool shown;  // false where nothing is to be seen: albedo and value mean nothing then
    vec3 albedo; // factor
    vec3 value;  // of the ball's nearest texel
};

BallPixel ballPixel(ivec2 pixel)
{
    BallPixel seen;
    vec2 packed = texelFetch(normals, pixel, 0).xy;
    ivec2 texel = nearestBallTexelOfPacked(packed, constants.size);
    seen.shown = dot(packed, packed) < 0.5; // what faces away, and what says that there is no normal, lies beyond
    seen.albedo = vec3(1.0);
    if (kModulated) {
        vec4 albedo = texelFetch(albedos, pixel, 0);
        int material = min(int(albedo.w), constants.materials - 1);
        seen.shown = seen.shown && int(albedo.w) < constants.materials;
        seen.albedo = albedo.rgb;
        int row = int((float(material) + 0.5) / constants.columns);
        texel += constants.size * ivec2(material - row * int(constants.columns), row);
    }
    seen.value = texelFetch(balls, texel, 0).rgb;
    return seen;
}
