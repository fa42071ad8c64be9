#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "engine/files/image.h"

namespace nacre {

// How an observation can be judged, and how that is shown. A verdict is an index into kVerdictKinds.
struct VerdictKind {
    const char* name;
    const char* meaning; // beside what the model predicts
    glm::vec3 colour;    // codes in [0,1]
};
inline constexpr std::array kVerdictKinds = {VerdictKind{"used", "as modelled", {0.92f, 0.92f, 0.92f}},
                                             VerdictKind{"shadow", "attached or cast", {0.35f, 0.55f, 1.0f}},
                                             VerdictKind{"highlight", "brighter", {0.98f, 0.82f, 0.24f}},
                                             VerdictKind{"saturated", "clipped", {0.94f, 0.27f, 0.24f}}};
inline constexpr uint8_t kNotJudged = 255;

// Each pixel's verdict as its colour, black where none was passed. The verdicts are those of `size` pixels, fitted into
// the picture as surfaces are.
Image verdictPicture(std::span<const uint8_t> verdicts, const glm::ivec2& size, int width, int height);

// Share of each kind in what was judged.
std::array<double, kVerdictKinds.size()> verdictShares(std::span<const uint8_t> verdicts);

// The legend as text: each kind's share, name and colour.
std::string describeVerdicts(std::span<const uint8_t> verdicts);

} // namespace nacre
