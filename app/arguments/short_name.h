#pragma once
#include <string>
#include <vector>

namespace nacre {

// What captions and file names call a material, target or rig: the file's stem, the fit's or the material's name; only
// letters, digits, ".", "-" and "_".
std::string shortName(const std::string& specification);

// The same of several, told apart by -2, -3, ... where they are alike.
std::vector<std::string> shortNames(const std::vector<std::string>& specifications);

} // namespace nacre
