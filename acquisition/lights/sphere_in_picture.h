#pragma once
#include "acquisition/capture/capture.h"

namespace nacre {

// The sphere's circle in the files' image coordinates. Without a mask: findCircle in the upper quartile of the
// photographs, where neither highlights nor cast shadows stay. Throws Error (data) where the crop is not inside of the
// photographs, or shows no circle.
Circle circleInPicture(const SphereInPicture& sphere, const Capture& capture);

} // namespace nacre
