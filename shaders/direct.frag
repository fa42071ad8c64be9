#version 460
// Direct lighting of one material by one group of lights: a lookup of its table per pixel and light, added to what the
// groups before it left. engine/scene/reference.cpp is the twin of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/layout.h"
#include "shared/shading.h"

layout(constant_id = kConstantLightCount) const int kLightCount = kLightsPerGroup;
layout(constant_id = kConstantCoordinates) const int kCoordinates = kHalfDifference;
layout(constant_id = kConstantOneMaterial) const bool kOneMaterial = false;
layout(constant_id = kConstantPacked) const bool kPacked = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingTable) uniform sampler3D table;
layout(scalar, binding = kBindingLights) uniform Lights
{
    LightFrame lights[kLightsPerGroup];
};
layout(scalar, push_constant) uniform Constants
{
    DirectConstants constants;
};

layout(location = 0) out vec4 radiance;

// 1/sr; m is the normal in the light's frame.
vec3 brdf(LightFrame light, vec3 n, vec3 m)
{
    vec3 unit;
    if (kCoordinates == kNatural) {
        unit = unitFromNatural(naturalFromDirections(n, lightDirection(light), constants.view.xyz));
    } else {
        unit = unitInFrame(light, m, constants.tableSize.w);
    }
    return textureLod(table, texelFromUnit(unit, constants.tableSize.xyz), 0.0).rgb;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 normal = texelFetch(normals, pixel, 0);
    vec4 albedo = kOneMaterial ? vec4(1.0) : texelFetch(albedos, pixel, 0);
    vec3 n = kPacked ? normalFromDisc(kPackedReach * normal.xy) : normal.xyz;
    bool hasNormal = kPacked ? isPackedNormal(normal.xy) : normal.w > 0.0;
    bool hasMaterial = kOneMaterial || int(albedo.w) == constants.material;
    if (!hasNormal || !hasMaterial || dot(n, constants.view.xyz) <= 0.0) {
        discard;
    }
    vec3 sum = vec3(0.0);
    [[unroll]] for (int i = 0; i < kLightCount; ++i) {
        vec3 m = normalInFrame(lights[i], n);
        sum += radianceFromBrdf(brdf(lights[i], n, m), lights[i].irradiance.rgb, cosineInFrame(lights[i], m));
    }
    radiance = vec4(albedo.rgb * sum, 0.0);
}
