#version 300 es
// One material's pixels of a shape under a few lights, as codes of the display: what direct.frag or ball.frag,
// residual.frag, display.frag and false_colour.frag do one after the other. engine/scene/reference.cpp is its twin. Row 0
// of the target is the picture's top. It draws the balls of ball.h, too.
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
precision highp sampler2DArray;
precision highp usampler2D;
#include "shared/ball.h"
#include "shared/coverage.h"
#include "shared/false_colour.h"
#include "shared/horizon.h"
#include "shared/lens.h"
#include "shared/light_frame.h"
#include "shared/near_light.h"
#include "shared/residual.h"
#include "shared/shading.h"
#include "shared/tone.h"

const int kMostPageLights = 8;
const float kNormalSteps = 8191.0; // of held_by_page.h
const int kShowBall = 16;          // beside those of false_colour.h

uniform usampler2D normals;      // codes of packed normals; 65535: none
uniform sampler2D albedos;       // RGB factor, A label; read where `material` says so
uniform sampler3D table;         // f in 1/sr, A its expected relative error
uniform sampler2DArray horizons; // codes of horizon.h / 255, a layer an azimuth
uniform sampler2D heights;       // R: the third coordinate of the pixel's place
uniform sampler2DArray residual; // codes of four components a layer
uniform sampler2D ball;          // of the material under these lights; read where ballSide says so

uniform int show;     // kShowPicture, kShowNormals, kShowLabels, kShowCoverage or kShowBall
uniform int material; // label that is shaded, -1: every pixel, its factor being 1
uniform int labels;   // of all materials; pixels of others are not shown
uniform ivec2 corner; // of the stored rectangle in the whole picture
uniform vec4 tableShape;    // texels; w largest thetaD
uniform int coordinates;    // of the table
uniform bool isJudged;      // the table tells its error
uniform int azimuths;       // of the horizons, 0: there are none
uniform vec4 placeFrame;    // xy the object's middle, z its width, in pixels; w 1 where lights or camera can be near
uniform vec4 viewpoint;     // see lens.h
uniform float ballSide;     // texels across of the ball that is read, or drawn; 0: none
uniform int lightCount;
uniform vec4 lights[kMostPageLights];      // xyz unit, towards the light; w 1 / distance, 0 of a distant one
uniform vec3 irradiances[kMostPageLights]; // that the BRDF sees
uniform int residualFours;                 // layers of four components, 0: none
uniform vec3 residualOffset;
uniform vec4 residualGains[kMostResidualLayers * kComponentsPerTexel];
uniform float gain; // 2^exposure

out vec4 code;

vec4 brdf(LightFrame light, vec3 view, vec3 n, vec3 m)
{
    vec3 unit = coordinates == kNatural ? unitFromNatural(naturalFromDirections(n, lightDirection(light), view))
                                        : unitInFrame(light, m, TableDomain(coordinates, tableShape.w));
    return textureLod(table, texelFromUnit(unit, tableShape.xyz), 0.0);
}

float shareOfLight(vec3 direction, ivec2 pixel)
{
    if (azimuths == 0) {
        return 1.0;
    }
    vec4 lookup = horizonLookup(direction, azimuths);
    float first = 255.0 * texelFetch(horizons, ivec3(pixel, int(lookup.x)), 0).r;
    float second = 255.0 * texelFetch(horizons, ivec3(pixel, int(lookup.y)), 0).r;
    return visibility(lookup, first, second);
}

vec3 placeOf(ivec2 pixel)
{
    vec2 middle = vec2(pixel + corner) + 0.5 - placeFrame.xy;
    return placeOnRay(viewpoint, vec2(middle.x, -middle.y) / placeFrame.z, texelFetch(heights, pixel, 0).r);
}

// RGB radiance by the BRDF, and by how much it may be off beyond what is allowed.
vec4 lit(vec3 n, vec3 view, vec3 place, ivec2 pixel)
{
    vec4 sum = vec4(0.0);
    for (int i = 0; i < kMostPageLights && i < lightCount; ++i) {
        vec4 met = lights[i].w > 0.0 ? lightFromPlace(lights[i].xyz, lights[i].w, place) : vec4(lights[i].xyz, 1.0);
        LightFrame light = lightFrame(met.xyz, view, met.w * irradiances[i]);
        vec3 m = normalInFrame(light, n);
        float nDotL = cosineInFrame(light, m);
        if (nDotL <= 0.0) {
            continue;
        }
        vec4 f = brdf(light, view, n, m);
        vec3 added = shareOfLight(directionInPicture(viewpoint, place, met.xyz), pixel) * radianceFromBrdf(f.rgb, light.irradiance.rgb, nDotL);
        float error = errorWithinTable(f.a, light.across.w, coordinates, tableShape.w);
        sum += vec4(added, errorBeyondBound(error, added));
    }
    return sum;
}

// What the ball of a page holds.
vec3 meanBrdf(vec3 n, vec3 view)
{
    vec3 sum = vec3(0.0), shares = vec3(1e-9);
    for (int i = 0; i < kMostPageLights && i < lightCount; ++i) {
        LightFrame light = lightFrame(lights[i].xyz, view, irradiances[i]);
        vec3 m = normalInFrame(light, n);
        vec3 share = shareInMean(light.irradiance.rgb, cosineInFrame(light, m));
        sum += share * brdf(light, view, n, m).rgb;
        shares += share;
    }
    return sum / shares;
}

// The same as lit where lights and camera are distant and nothing casts a shadow: one lookup for all lights.
vec4 litByBall(vec3 n)
{
    vec3 f = textureLod(ball, ballTexelFromNormal(n, ballSide), 0.0).rgb, sum = vec3(0.0);
    for (int i = 0; i < kMostPageLights && i < lightCount; ++i) {
        sum += radianceFromBrdf(f, irradiances[i], dot(n, lights[i].xyz));
    }
    return vec4(sum, 0.0);
}

vec3 residualOf(ivec2 pixel)
{
    vec3 sum = residualOffset;
    for (int i = 0; i < kMostResidualLayers * kFoursPerTexel && i < residualFours; ++i) {
        sum += residualOfFour(texelFetch(residual, ivec3(pixel, i), 0), residualGains[4 * i], residualGains[4 * i + 1],
                              residualGains[4 * i + 2], residualGains[4 * i + 3]);
    }
    return sum;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    if (show == kShowBall) {
        code = vec4(meanBrdf(normalFromBallTexel(gl_FragCoord.xy / ballSide, ballSide), viewpoint.xyz), 1.0);
        return;
    }
    vec2 disc = vec2(texelFetch(normals, pixel, 0).xy) / kNormalSteps - 1.0;
    vec4 albedo = material < 0 ? vec4(1.0, 1.0, 1.0, 0.0) : texelFetch(albedos, pixel, 0);
    int label = int(albedo.a + 0.5);
    vec3 n = normalFromDisc(kPackedReach * disc);
    bool isPicture = show == kShowPicture || show == kShowCoverage;
    bool isMine = material < 0 || (isPicture ? label == material : label < labels);
    vec3 place = placeFrame.w > 0.0 ? placeOf(pixel) : vec3(0.0);
    vec3 view = viewFromPlace(viewpoint, place);
    if (!isPackedNormal(disc) || (isPicture ? dot(n, view) : n.z) <= 0.0 || !isMine) {
        discard;
    }
    if (!isPicture) {
        FalseColourConstants none = FalseColourConstants(vec4(view, 0.0), vec4(0.0), vec4(0.0), labels);
        code = vec4(falseColour(show, n, label, none), 1.0);
        return;
    }
    vec4 radiance = ballSide > 0.0 ? litByBall(n) : lit(n, view, place, pixel);
    vec3 all = albedo.rgb * radiance.rgb;
    if (residualFours > 0) {
        all += residualOf(pixel);
    }
    vec3 shown = displayCode(gain * all, kToneSrgb);
    bool isStriped = show == kShowCoverage && isJudged && radiance.a > 0.0;
    code = vec4(isStriped ? hatched(shown, pixel + corner) : shown, 1.0);
}
