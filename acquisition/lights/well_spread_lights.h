#pragma once
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"
#include "acquisition/lights/lights.h"

namespace nacre {

constexpr int kFewestLightsGiven = 3; // as many as a normal and its albedo have unknowns

// Which photographs of a capture an estimate may see.
struct LightChoice {
    size_t given = 0;        // that many well-spread ones; 0: all that are not held out
    size_t heldOutEvery = 0; // 7: photographs 0, 7, 14, ... are kept back for a judgement; 0: none
    size_t heldOutFirst = 0; // 2: photographs 2, 9, 16, ...
};

// Whether photograph `index`, counted from 0, is one of every `every`: the first is, so that of 96 every seventh makes
// 14, and 82 stay.
constexpr bool isHeldOutOfEvery(size_t index, size_t every, size_t first = 0)
{
    return every > 0 && index % every == first;
}

// `count` of the candidates (indices of `directions`), ascending: the first candidate, then always the one whose
// smallest angle to those chosen is largest (Gonzalez, Clustering to minimize the maximum intercluster distance, 1985),
// the first of equals. `count` is at most the number of candidates; opposite directions are 180 degrees apart.
std::vector<size_t> farthestFirst(const std::vector<glm::vec3>& directions, const std::vector<size_t>& candidates,
                                  size_t count);

// The photographs that a choice gives, ascending. Throws Error (usage) where it asks for fewer than three or for more
// than there are.
std::vector<size_t> chosenLights(const std::vector<Light>& lights, const LightChoice& choice);

// The lights of the photographs named; the rig's condition is that of the lights left.
std::vector<Light> selectLights(const std::vector<Light>& lights, const std::vector<size_t>& chosen);
Rig selectLights(const Rig& rig, const std::vector<size_t>& chosen);

} // namespace nacre
