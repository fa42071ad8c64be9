// Pictures of what shading starts from: normals, labels, coordinates, coverage. Code values of the display in [0,1].
#ifndef NACRE_FALSE_COLOUR_H
#define NACRE_FALSE_COLOUR_H
#include "coverage.h"
NACRE_SHARED_BEGIN

const int kShowPicture = 0;
const int kShowNormals = 1;
const int kShowLabels = 2;
const int kShowCoverage = 3;
const int kShowThetaH = 4;
const int kShowThetaD = 5;

struct FalseColourConstants {
    vec4 view;     // xyz unit, towards the viewer; w = thetaD of the light in radians
    vec4 half_;    // xyz unit, between light and viewer
    vec4 light;    // xyz unit, towards the light; w = 0 where there is none
    int materials; // labels from here on are none
};

NACRE_FN vec3 normalColour(vec3 n)
{
    return 0.5f * n + 0.5f;
}

// Eight colours that the colour-blind tell apart (Okabe and Ito, Color Universal Design, 2008; light grey in place of
// black); half as bright from the ninth on, and darker still from the 17th.
NACRE_FN vec3 labelColour(int label)
{
    int kind = label - 8 * (label / 8), ring = label / 8 - 3 * (label / 24);
    vec3 colour = kind == 0   ? vec3(230.0f, 159.0f, 0.0f)
                  : kind == 1 ? vec3(86.0f, 180.0f, 233.0f)
                  : kind == 2 ? vec3(0.0f, 158.0f, 115.0f)
                  : kind == 3 ? vec3(240.0f, 228.0f, 66.0f)
                  : kind == 4 ? vec3(0.0f, 114.0f, 178.0f)
                  : kind == 5 ? vec3(213.0f, 94.0f, 0.0f)
                  : kind == 6 ? vec3(204.0f, 121.0f, 167.0f)
                              : vec3(230.0f, 230.0f, 230.0f);
    return (ring == 0 ? 1.0f : ring == 1 ? 0.5f : 0.28f) / 255.0f * colour;
}

// Least squares of the colour map viridis (Smith, van der Walt, matplotlib, 2015) on [0,1], off by at most 0.014.
NACRE_FN vec3 viridis(float value)
{
    float x = clamp(value, 0.0f, 1.0f);
    vec3 c = vec3(-4.563226f, 4.752997f, 27.761859f);
    c = c * x + vec3(2.816101f, -14.048358f, -69.202300f);
    c = c * x + vec3(7.532927f, 14.456042f, 60.338358f);
    c = c * x + vec3(-4.745534f, -5.902764f, -20.812209f);
    c = c * x + vec3(-0.480305f, 0.249221f, 0.334506f);
    c = c * x + vec3(0.153876f, 1.392361f, 1.382803f);
    c = c * x + vec3(0.271517f, 0.005995f, 0.331670f);
    return clamp(c, 0.0f, 1.0f);
}

// Angles of coordinates, from 0 (dark blue) to 90 degrees (yellow).
NACRE_FN vec3 angleColour(float radians_)
{
    return viridis(radians_ / kHalfPi);
}

// Diagonal stripes of two pixels in eight.
NACRE_FN vec3 hatched(vec3 code, ivec2 pixel)
{
    int along = pixel.x + pixel.y;
    return along - 8 * (along / 8) < 2 ? vec3(0.9f, 0.1f, 0.7f) : code;
}

// Of a pixel whose normal faces the viewer, for any `show` but the picture and its coverage.
NACRE_FN vec3 falseColour(int show, vec3 n, int label, FalseColourConstants c)
{
    if (show == kShowNormals) {
        return normalColour(n);
    }
    if (show == kShowLabels) {
        return labelColour(label);
    }
    bool isLit = c.light.w > 0.0f && dot(n, vec3(c.light)) > 0.0f; // others look nothing up
    float angle = show == kShowThetaH ? angleBetween(n, vec3(c.half_)) : c.view.w;
    return isLit ? angleColour(angle) : vec3(0.0f);
}

NACRE_SHARED_END
#endif
