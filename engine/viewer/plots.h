#pragma once
#include <span>

#include "engine/viewer/lobe.h"
#include "engine/viewer/photographs.h"

namespace nacre {

// Drawn at ImGui's cursor, over the width of its window. `height` in pixels.

// The lobe about the normal (up), the light's direction as a line; what was not measured is dim. The radius is f's mean
// over channels, relative to its largest value.
void plotLobe(std::span<const LobeSample> samples, float incidence, float height);

// Observations over n.l from 0 to 1, coloured by their verdict, and what the model predicts of each as a short line.
void plotObservations(std::span<const PixelObservation> observations, float height);

} // namespace nacre
