// What the shaders and the renderer agree on: bindings, push constants, the light. Scalar layout.
#ifndef NACRE_LAYOUT_H
#define NACRE_LAYOUT_H
#include "false_colour.h"
#include "horizon.h"
#include "light_frame.h"
NACRE_SHARED_BEGIN

// Sampled 2D: xyz unit normal in the camera frame, w confidence (all 0 = no data); or packed, see ball.h.
const int kBindingNormals = 0;
const int kBindingAlbedo = 1;  // sampled 2D: RGB albedo factor, w material index as a float, 255 = none
const int kBindingTable = 2;   // sampled 3D: BRDF in 1/sr, w its expected relative error
const int kBindingLights = 3;  // uniform buffer of kLightsPerGroup LightFrame
const int kBindingInput = 4;   // sampled 2D: what an earlier pass drew (radiance, or balls)
const int kBindingHorizon = 5; // sampled 2D array: a layer an azimuth, codes of horizon.h / 255

const int kBindingResidual = 6;        // texel buffer of integers: codes of components, see residual.h
const int kBindingResidualWeights = 7; // texel buffer: ResidualWeights

const int kBindingPlaces = 8; // sampled 2D: xyz the pixel's point in widths of the object, see near_light.h and lens.h
const int kBindingCover = 9;  // sampled 2D array of one layer: share of the pixel that the object covers, see zoom.h
const int kBindingBallPlaces = 10; // sampled 2D of integers: where four pixels look in the balls, see ball.h

// Lights of one draw. The loop over them is unrolled, so that their fields are loaded once for all pixels.
const int kLightsPerGroup = 4;

// Index of a specialisation constant, one meaning a shader.
const int kConstantLightCount = 0;  // direct.frag: lights of the group, 1 to kLightsPerGroup
const int kConstantCoordinates = 1; // direct.frag: of the table
const int kConstantOneMaterial = 2; // direct.frag: all pixels have it and albedo 1
const int kConstantPacked = 3;      // direct.frag: normals are packed
const int kConstantCoverage = 4;    // direct.frag: alpha tells how far off radiance may be
const int kConstantShadows = 5;     // direct.frag: the height casts shadows
const int kConstantPlaced = 6; // direct.frag: pixels' places matter, since a light of the group or the camera is near
const int kConstantModulated = 0;         // ball*.frag, floor.frag, false_colour.frag: factors and labels
const int kConstantToneCurve = 1;         // ball*.frag, display.frag
const int kConstantBallResidual = 2;      // ball.frag: components, in fours; 0: no layer
const int kConstantPackedNormals = 0;     // residual.frag
const int kConstantResidualFours = 1;     // residual.frag: components, in fours
const int kConstantResidualModulated = 2; // residual.frag: pixels have labels
const int kConstantHatched = 0;           // display.frag: stripes where alpha is positive
const int kConstantShow = 1;              // false_colour.frag
const int kConstantReach = 0;             // zoom.frag: pixels along a side of which a mean is taken

struct DirectConstants {
    vec4 view;      // viewpoint, see lens.h
    vec4 tableSize; // xyz texels of the 3D table; w = largest thetaD on its grid
    int material;   // index that this pass shades
    int firstRow;   // of the surface, in the target's row 0
    // One a light: 1 / distance in widths of the object, 0 of distant lights; read where places matter.
    float nearness[kLightsPerGroup];
    vec4 horizon[kLightsPerGroup]; // horizonLookup of each light, where there are shadows and places do not matter
};

// Of shaders that draw several pixels at once: codes, side by side in a texel of the target.
const int kPixelsPerTexel = 4;

// Of ball_places.frag: balls of one size lie side by side in one texture, material 0 at the top left.
struct BallPlacesConstants {
    int size;      // texels across one ball
    int columns;   // balls side by side
    int materials; // balls in all
    int width;     // pixels, of the picture
};

struct BallConstants {
    int firstRow; // of the picture, in the target's row 0
    int width;    // pixels, of the picture
};

struct FloorConstants {
    int firstRow; // of the picture, in the target's row 0
    int width;    // pixels, of the picture
};

// Of ball_display.frag: one ball is stretched and encoded into its place.
struct BallDisplayConstants {
    vec2 origin;     // texel of its place's top left corner
    float size;      // texels across its place
    float inputSize; // texels across the radiance ball
    float gain;      // 2^exposure
};

struct ResidualConstants {
    int materials; // pixels of others are not shown
    int firstRow;  // of the surface, in the target's row 0
    int width;     // pixels, of the surface
};

// Of zoom.frag, which reduces a picture.
struct ZoomConstants {
    vec2 origin; // of the target's top left corner, in pixels of the picture
    float scale; // the target's pixels a pixel of the picture
};

struct DisplayConstants {
    float gain;   // 2^exposure
    int firstRow; // of the picture, in the radiance's row 0
};

NACRE_SHARED_END
#endif
