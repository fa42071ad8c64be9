#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "engine/exchange/lobe_model.h"

namespace nacre {

struct MaterialXMaterial {
    std::string name; // any text; kept whole as uiname
    LobeShape shape;
    LobeColours colours; // of standardSurfaceModel
};

// A MaterialX 1.38 document with a standard_surface and a surfacematerial node each, colours linear Rec. 709
// (lin_rec709). Names of nodes are the materials', other characters than letters and digits being underscores, and
// numbered where they meet. radianceScale: what radiance is to be multiplied by, in the document's doc where it is
// not 1.
std::string materialXText(const std::vector<MaterialXMaterial>& materials, float radianceScale);

} // namespace nacre
