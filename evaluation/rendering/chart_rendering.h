#pragma once
#include <string>

#include "engine/surface/surface.h"
#include "evaluation/charts/chart_measurement.h"

namespace nacre {

// Frames of what the capture becomes by default, on a Vulkan device: a row for every path, size of ball and number of
// lights that can be drawn. The reference is the CPU twin's radiance by the display's curve, before codes are rounded:
// rounding alone leaves 58.9 dB (a uniform error of one code's width).
void measureRendering(const Capture& capture, const AcquireOptions& options, const RenderingChoices& choices,
                      const std::string& device, const ChartObserver& observer, std::vector<RenderingRow>& rows);

// The object again and again, side by side, until it fills a picture of that size: frames of every capture then have
// the same number of pixels, and the captures' own mixture of normals, materials and albedo factors.
Surface tiledSurface(const Surface& surface, int width, int height);

size_t countSettings(const RenderingChoices& choices);

} // namespace nacre
