#pragma once
#include <string>
#include <vector>

namespace nacre {

// The name that the fewest letters changed, left out or put in make of what was typed: at most a third of its letters,
// and two. Empty where none is so near.
std::string nearestName(const std::string& typed, const std::vector<std::string>& names);

} // namespace nacre
