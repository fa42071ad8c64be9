#pragma once
#include "assets/cloth/cloth_sheet.h"
#include "assets/synth/target.h"

namespace nacre {

// The smooth surface through about the sheet's particles (a bicubic B-spline's), seen by a distant camera that looks
// along -z; the picture's shorter side spans [-1, 1]. The side of rising u x v is part 0, the other part 1; both are
// shown with normals towards the viewer.
Target sheetPicture(const ClothSheet& sheet, int width, int height, std::vector<std::string> parts, int threads);

} // namespace nacre
