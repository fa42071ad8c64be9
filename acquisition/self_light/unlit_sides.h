#pragma once
#include <vector>

#include "acquisition/normals/intensities.h"

namespace nacre {

// Grey, of pixels spread over an object: what they show of every light, and what arrives from the rest of the object.
struct SelfLitPixels {
    Intensities seen;
    Intensities arriving; // K I / E
    Intensities cosines;  // n.l
};

// What sides that face away from a light show of it: a constant share of the pixel's brightness, which is stray light
// of the room and the camera, and what comes from the rest of the object,
//   I = constant * bright level + s a K I.
struct UnlitFit {
    float strength = 0;   // s
    double explained = 0; // share of the residuals beside the best constant alone that s takes away
    bool isSure = false;  // that it takes any away is more than chance
};
UnlitFit fitUnlitSides(const SelfLitPixels& pixels);

} // namespace nacre
