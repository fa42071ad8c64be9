#pragma once
#include "engine/files/image.h"

namespace nacre {

// The longest of 1, 2 or 5 times a power of ten millimetres that covers at most a quarter of the width.
double scaleBarLength(int width, double pixelsPerMillimetre);

// Draws it in white on a black plate in the lower left corner of an RGB picture, its length above it. Throws Error
// where the picture is too small, or no font is installed.
void drawScaleBar(Image& picture, double pixelsPerMillimetre);

} // namespace nacre
