#pragma once
#include <filesystem>

#include "engine/surface/surface.h"

namespace nacre {

// A surface's colour per pixel without its highlights and its shading: the reflectance factor pi a f of the albedo
// factor a and the material's f at CIE's 45:0 geometry, lit at 45 degrees and seen along the normal. It is what the
// diffuse reflectance is where there is no gloss; up to the capture's factor where the scale is relative.
Image exportedAlbedo(const Surface& surface);

// EXR: floats. PNG: 16 bits, linear, divided by a power of two that brings the largest value to at most 1 and is
// written as the text nacre:albedoScale. Answers that power of two, 1 for EXR.
float saveAlbedo(const std::filesystem::path& file, const Image& albedo);

} // namespace nacre
