#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "acquisition/capture/capture.h"

namespace nacre {

// Where a calibration sphere stands in the object's own photographs.
struct SphereInPicture {
    int x = 0; // of the crop around it, in pixels of the files
    int y = 0;
    int width = 0;
    int height = 0;
    std::filesystem::path mask; // white on the sphere, of the files' size or the crop's; empty: its outline is found
};

// "in-picture:X,Y,W,H[,MASK]", as `option` has it; empty where `specification` is a folder. Throws Error (usage).
std::optional<SphereInPicture> sphereInPicture(const std::string& option, const std::filesystem::path& specification);

// The capture's own photographs as those of the sphere; its circle is to be found.
SpherePhotographs photographsOfSphere(const SphereInPicture& sphere, const Capture& capture);

// The sphere's circle in the files' image coordinates. Without a mask: findCircle in the upper quartile of the
// photographs, where neither highlights nor cast shadows stay. Throws Error (data) where the crop is not inside of the
// photographs, or shows no circle.
Circle circleInPicture(const SphereInPicture& sphere, const Capture& capture);

} // namespace nacre
