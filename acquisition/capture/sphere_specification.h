#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "acquisition/capture/capture.h"

namespace nacre {

// "in-picture:X,Y,W,H[,MASK]", as `option` has it; empty where `specification` is a folder. Throws Error (usage).
std::optional<SphereInPicture> sphereInPicture(const std::string& option, const std::filesystem::path& specification);

// "X,Y,W,H".
std::string rectangleOf(const SphereInPicture& sphere);

// The capture's own photographs as those of the sphere; its circle is to be found.
SpherePhotographs photographsOfSphere(const SphereInPicture& sphere, const Capture& capture);

} // namespace nacre
