#version 460
// Direct lighting of one material by one group of lights: a lookup of its table per pixel and light, added to what the
// groups before it left; alpha likewise adds up by how much the radiance may be off (coverage.h), where that is asked for.
// engine/scene/reference.cpp is the twin of this file on the CPU.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/ball.h"
#include "shared/coverage.h"
#include "shared/layout.h"
#include "shared/lens.h"
#include "shared/near_light.h"
#include "shared/shading.h"

layout(constant_id = kConstantLightCount) const int kLightCount = kLightsPerGroup;
layout(constant_id = kConstantCoordinates) const int kCoordinates = kHalfDifference;
layout(constant_id = kConstantOneMaterial) const bool kOneMaterial = false;
layout(constant_id = kConstantPacked) const bool kPacked = false;
layout(constant_id = kConstantCoverage) const bool kCoverage = false;
layout(constant_id = kConstantShadows) const bool kShadows = false;
layout(constant_id = kConstantPlaced) const bool kPlaced = false;

layout(binding = kBindingNormals) uniform sampler2D normals;
layout(binding = kBindingAlbedo) uniform sampler2D albedos;
layout(binding = kBindingTable) uniform sampler3D table;
layout(binding = kBindingHorizon) uniform sampler2DArray horizons;
layout(binding = kBindingPlaces) uniform sampler2D places;
layout(scalar, binding = kBindingLights) uniform Lights
{
    LightFrame lights[kLightsPerGroup];
};
layout(scalar, push_constant) uniform Constants
{
    DirectConstants constants;
};

layout(location = 0) out vec4 radiance;

// RGB in 1/sr and its expected error; m is the normal in the light's frame.
vec4 brdf(LightFrame light, vec3 view, vec3 n, vec3 m)
{
    vec3 unit;
    if (kCoordinates == kNatural) {
        unit = unitFromNatural(naturalFromDirections(n, lightDirection(light), view));
    } else {
        unit = unitInFrame(light, m, TableDomain(kCoordinates, constants.tableSize.w));
    }
    return textureLod(table, texelFromUnit(unit, constants.tableSize.xyz), 0.0);
}

// The light as the pixel meets it.
LightFrame metLight(int i, vec3 view, vec3 place)
{
    if (!kPlaced) {
        return lights[i];
    }
    vec4 met = lightFromPlace(lightDirection(lights[i]), constants.nearness[i], place);
    return lightFrame(met.xyz, view, met.w * lights[i].irradiance.rgb);
}

// Share of the light's radiance that no height in its way takes.
float shareOfLight(vec4 lookup, ivec2 pixel)
{
    float code = 255.0 * texelFetch(horizons, ivec3(pixel, int(lookup.x)), 0).r;
    float nextCode = 255.0 * texelFetch(horizons, ivec3(pixel, int(lookup.y)), 0).r;
    return visibility(lookup, code, nextCode);
}

vec4 lookupOf(int i, LightFrame light, vec3 place)
{
    if (!kPlaced) {
        return constants.horizon[i];
    }
    return horizonLookup(directionInPicture(constants.view, place, lightDirection(light)), textureSize(horizons, 0).z);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy) + ivec2(0, constants.firstRow);
    vec4 normal = texelFetch(normals, pixel, 0);
    vec4 albedo = kOneMaterial ? vec4(1.0) : texelFetch(albedos, pixel, 0);
    vec3 n = kPacked ? normalFromDisc(kPackedReach * normal.xy) : normal.xyz;
    bool hasNormal = kPacked ? isPackedNormal(normal.xy) : normal.w > 0.0;
    bool hasMaterial = kOneMaterial || int(albedo.w) == constants.material;
    vec3 place = kPlaced ? texelFetch(places, pixel, 0).xyz : vec3(0.0);
    vec3 view = kPlaced ? viewFromPlace(constants.view, place) : constants.view.xyz;
    if (!hasNormal || !hasMaterial || dot(n, view) <= 0.0) {
        discard;
    }
    vec3 sum = vec3(0.0);
    float beyond = 0.0;
    [[unroll]] for (int i = 0; i < kLightCount; ++i) {
        LightFrame light = metLight(i, view, place);
        vec3 m = normalInFrame(light, n);
        vec4 f = brdf(light, view, n, m);
        float nDotL = cosineInFrame(light, m);
        float arriving = kShadows ? shareOfLight(lookupOf(i, light, place), pixel) : 1.0;
        vec3 added = arriving * radianceFromBrdf(f.rgb, light.irradiance.rgb, nDotL);
        sum += added;
        if (kCoverage) {
            beyond +=
                errorBeyondBound(errorWithinTable(f.w, light.across.w, kCoordinates, constants.tableSize.w), added);
        }
    }
    radiance = vec4(albedo.rgb * sum, beyond);
}
