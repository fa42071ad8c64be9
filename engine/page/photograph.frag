#version 300 es
// A photograph at another exposure than the one that it was stored at.
precision highp float;
precision highp int;
precision highp sampler2D;
#include "shared/shading.h"
#include "shared/tone.h"

uniform sampler2D photograph; // sRGB codes
uniform float gain;           // of the linear value

out vec4 code;

void main()
{
    vec3 stored = texelFetch(photograph, ivec2(gl_FragCoord.xy), 0).rgb;
    vec3 linear = vec3(linearFromSrgb(stored.r), linearFromSrgb(stored.g), linearFromSrgb(stored.b));
    code = vec4(displayCode(gain * linear, kToneSrgb), 1.0);
}
