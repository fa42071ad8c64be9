#version 460
// What a distant camera sees of a mesh: the normal's x and y (z is above 0), the height in pixels, the part's label + 1;
// or the normal alone, packed. Of a relief the label is the number of its picture's pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/ball.h"
#include "shared/mesh_layout.h"

layout(constant_id = kConstantMeshMapped) const bool kMapped = false;
layout(constant_id = kConstantMeshPacked) const bool kPacked = false;

layout(binding = kBindingMeshNormalMap) uniform sampler2D normalMap;
layout(scalar, push_constant) uniform Constants
{
    MeshConstants constants;
};

layout(location = 0) in float height;
layout(location = 1) in vec3 shadingNormal;
layout(location = 2) in vec4 shadingTangent;
layout(location = 3) in vec2 mapPlace;

layout(location = 0) out vec4 seen;

// The triangle's own normal on the side that is seen, whatever its winding: the slope of its height.
vec3 facingNormal()
{
    float right = dFdx(height) * constants.samplesPerPixel;
    float down = dFdy(height) * constants.samplesPerPixel;
    return normalize(vec3(-right, down, 1.0));
}

// The map repeated over the plane, bilinear between its four texels.
vec3 mappedNormal(vec2 uv)
{
    ivec2 size = textureSize(normalMap, 0);
    vec2 texel = vec2(fract(uv.x), fract(1.0 - fract(uv.y))) * vec2(size) - 0.5;
    vec2 share = fract(texel);
    ivec2 first = (ivec2(floor(texel)) + size) % size;
    ivec2 second = (first + 1) % size;
    vec3 top = mix(texelFetch(normalMap, first, 0).xyz, texelFetch(normalMap, ivec2(second.x, first.y), 0).xyz, share.x);
    vec3 bottom =
        mix(texelFetch(normalMap, ivec2(first.x, second.y), 0).xyz, texelFetch(normalMap, second, 0).xyz, share.x);
    return mix(top, bottom, share.y);
}

// Where nothing is seen: what is not known of a relief hides what lies behind.
vec4 nothing()
{
    return kPacked ? vec4(1.0, 1.0, 0.0, 0.0) : vec4(0.0);
}

void main()
{
    bool isRelief = constants.columns > 0.0;
    if (constants.label == 0.0 || (isRelief && !gl_FrontFacing)) {
        seen = nothing();
        return;
    }
    vec3 facing = facingNormal();
    vec3 n = shadingNormal;
    if (kMapped) {
        // Not normalised before: as the maps were baked (Mikkelsen 2008).
        vec3 bitangent = shadingTangent.w * cross(shadingNormal, shadingTangent.xyz);
        vec3 m = mappedNormal(mapPlace);
        n = m.x * shadingTangent.xyz + m.y * bitangent + m.z * shadingNormal;
    }
    // A sheet that is seen from behind, or normals that point inwards.
    n = dot(shadingNormal, facing) < 0.0 && !isRelief ? -n : n;
    n = dot(n, n) > 0.0 ? normalInSight(normalize(n)) : facing;
    float label = isRelief ? floor(mapPlace.y) * constants.columns + floor(mapPlace.x) + 1.0 : constants.label;
    seen = kPacked ? vec4(packedFromNormal(n), 0.0, 0.0) : vec4(n.xy, height, label);
}
