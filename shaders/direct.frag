#version 460
// Direct lighting of one material: per pixel and light one lookup of its table. engine/scene/reference.cpp is the twin
// of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shared/layout.h"
#include "shared/shading.h"

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingTable) uniform sampler3D table;
layout(scalar, binding = kBindingLights) uniform Lights
{
    GpuLight lights[kMaxLightsPerPass];
};
layout(scalar, push_constant) uniform Constants
{
    DirectConstants constants;
};

layout(location = 0) out vec4 radiance;

// 1/sr
vec3 brdf(vec3 n, vec3 l, vec3 v)
{
    vec3 unit = unitFromDirections(constants.domain, n, l, v);
    return textureLod(table, texelFromUnit(unit, constants.tableSize.xyz), 0.0).rgb;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 normal = texelFetch(normals, pixel, 0);
    vec4 albedo = texelFetch(albedos, pixel, 0);
    vec3 n = normal.xyz;
    vec3 v = constants.view.xyz;
    bool hasNormal = normal.w > 0.0;
    bool hasMaterial = int(albedo.w) == constants.material;
    if (!hasNormal || !hasMaterial || dot(n, v) <= 0.0) {
        discard;
    }
    vec3 sum = vec3(0.0);
    for (int i = 0; i < constants.lightCount; ++i) {
        vec3 l = lights[i].direction.xyz;
        float nDotL = dot(n, l);
        if (nDotL > 0.0) {
            sum += radianceFromBrdf(brdf(n, l, v), lights[i].irradiance.rgb, nDotL);
        }
    }
    radiance = vec4(albedo.rgb * sum, 0.0);
}
