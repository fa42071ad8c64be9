// What the shaders and the renderer agree on: bindings, push constants, the light. Scalar layout.
#ifndef NACRE_LAYOUT_H
#define NACRE_LAYOUT_H
#include "brdf_coords.h"
NACRE_SHARED_BEGIN

const int kBindingNormals = 0; // sampled 2D: xyz unit normal in the camera frame, w confidence (0 = no data)
const int kBindingAlbedo = 1;  // sampled 2D: RGB albedo factor, w material index as a float, 255 = none
const int kBindingTable = 2;   // sampled 3D: BRDF in 1/sr
const int kBindingLights = 3;  // uniform buffer of GpuLight

// Lights of one pass; more lights take more passes that add up.
const int kMaxLightsPerPass = 256;

struct GpuLight {
    vec4 direction;  // xyz unit, from the surface towards the light
    vec4 irradiance; // rgb on a plane facing the light
};

struct DirectConstants {
    vec4 view;          // xyz unit, towards the viewer
    vec4 tableSize;     // xyz texels of the 3D table
    TableDomain domain; // of the table
    int lightCount;     // in the bound light buffer
    int material;       // index that this pass shades
};

NACRE_SHARED_END
#endif
