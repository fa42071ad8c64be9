#pragma once
#include <optional>

#include "acquisition/capture/capture.h"
#include "engine/files/image.h"

namespace nacre {

// The circle along most of which a picture of one channel changes, whatever is inside and outside: a sphere's outline.
// Circles through three edge points are tried (Fischler and Bolles, Random sample consensus, 1981), the best is fitted
// to the edges along its rays. Empty where none of at least a fifth of the picture's shorter side is wholly inside, or
// less than 0.6 of it is seen.
std::optional<Circle> findCircle(const Image& picture);

// The sphere's circle in the files' image coordinates. Without a mask: findCircle in the upper quartile of the
// photographs, where neither highlights nor cast shadows stay. Throws Error (data) where the crop is not inside of the
// photographs, or shows no circle.
Circle circleInPicture(const SphereInPicture& sphere, const Capture& capture);

} // namespace nacre
