#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "acquisition/brdf/albedo_factor.h"
#include "acquisition/capture/capture.h"
#include "engine/brdf/brdf_table.h"

namespace nacre {

// Gives pixels that share an albedo the median of their factors, channel by channel. What their own ones differ by is
// noise, light that bounced, or how the material looks from aside, which belongs to its BRDF.
void shareAlbedos(const NormalMap& normals, std::span<const uint8_t> labels, std::span<const uint8_t> haveOneAlbedo,
                  Image& albedo);

// refitAlbedo of albedo_factor.h with every pixel's own material; labels are indices into `tables`, null where a
// material's factors stay as they are.
void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights,
                 std::span<const uint8_t> labels, std::span<BrdfTable* const> tables, int threads, Image& albedo);

// Smooths factors in where the capture marks it, and makes their mean, or their median where they share one albedo, 1
// over each material's pixels: no material's factors reach another's. The tables take what was divided out; it is
// answered as well.
std::vector<glm::vec3> finishAlbedo(const Capture& capture, std::span<const uint8_t> labels,
                                    std::span<const uint8_t> haveOneAlbedo, std::span<BrdfTable* const> tables,
                                    Image& albedo);

} // namespace nacre
